// Which samples of a pixel are on the film: ranges of their indices, in ascending order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "norrsken/samples.h"
#include "tables/wave_types.h"

namespace norrsken {

class SampleSet {
 public:
  /// All there are.
  SampleSet() : ranges_{{0, 0xffffffffu}} {}
  /// Disjoint and ascending.
  explicit SampleSet(std::vector<SampleRange> ranges) : ranges_(std::move(ranges)) {}

  /// Of an image that is not finished: how many samples of each range the tiles have, in rows from the top.
  struct Tiles {
    std::uint32_t width, height;  ///< of a tile, in pixels
    std::uint32_t columns, image_width;
    std::vector<std::vector<std::uint32_t>> done;  ///< range by range
  };
  SampleSet(std::vector<SampleRange> ranges, Tiles tiles) : ranges_(std::move(ranges)), tiles_(std::move(tiles)) {}

  /// How many of the pixel's n samples, the first ones of the set that it may have, belong to replicate r.
  std::uint32_t count_of_replicate(std::uint64_t pixel, std::uint32_t n, std::uint32_t r) const {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      const SampleRange& range = ranges_[i];
      const std::uint32_t most = tiles_ ? tiles_->done[i][tile_of(pixel)] : range.end - range.first;
      const std::uint32_t taken = std::min(n, most);
      count += below(range.first + taken, r) - below(range.first, r);
      n -= taken;
    }
    return count;
  }

 private:
  std::size_t tile_of(std::uint64_t pixel) const {
    const std::uint64_t x = pixel % tiles_->image_width, y = pixel / tiles_->image_width;
    return y / tiles_->height * tiles_->columns + x / tiles_->width;
  }
  /// How many of the samples 0 to end - 1 belong to replicate r.
  static std::uint32_t below(std::uint32_t end, std::uint32_t r) {
    return end / kReplicates + (end % kReplicates > r ? 1u : 0u);
  }

  std::vector<SampleRange> ranges_;
  std::optional<Tiles> tiles_;
};

}  // namespace norrsken
