// How a render is cut into waves. The cut never shows in the image: random numbers are addressed by pixel and sample,
// and every pixel's samples are added in order.
#pragma once

#include <cstdint>

#include "tables/wave_types.h"

namespace norrsken {

class WorkPlan {
 public:
  WorkPlan(std::uint32_t width, std::uint32_t height, std::uint64_t samples, std::uint32_t slots_per_wave);

  std::uint64_t wave_count() const { return blocks_ * tiles_; }
  std::uint64_t tile_count() const { return tiles_; }
  std::uint64_t tile_of(std::uint64_t wave) const { return wave % tiles_; }
  std::uint64_t block_of(std::uint64_t wave) const { return wave / tiles_; }
  /// All tiles take their first block of samples, then all their second, ...
  WaveJob wave(std::uint64_t index) const;

 private:
  std::uint32_t width_, height_, tile_width_, tile_height_, tiles_x_, block_;
  std::uint64_t samples_, tiles_, blocks_;
};

}  // namespace norrsken
