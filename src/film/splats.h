// What paths from the lights leave on the film, and what it says about the image and its error. A path may land on any
// pixel, so a pixel's value is the sum of what landed there over the number of all paths, whoever's they were.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "film/exact_planes.h"
#include "film/pixel_estimate.h"
#include "tables/film_view.h"
#include "tables/wave_types.h"

namespace norrsken {

/// Sums per pixel and replicate. Sample s of every path belongs to replicate s % kLightReplicates, also where samples
/// are independent: a path that lands elsewhere counts for a pixel's variance too. Which paths come first depends on how the
/// work is cut; the sums do not, being exact.
class Splats {
 public:
  /// None, without memory.
  Splats() = default;
  /// `filter` is the scene's table (src/rfilter/filter.h).
  Splats(const FilmSettings& settings, std::span<const float> filter);

  bool exist() const { return !sums_.empty(); }

  /// Adds a part of a wave's splats, in their order. Those that are not finite are left out and counted, told by the
  /// number of the path in place of the pixel's.
  void add(const WaveJob& job, const Queue<stored::Splat>& splats, DroppedSamples& dropped);
  /// Counts a wave's paths, when all their splats have been added.
  void count_paths(const WaveJob& job);

  PixelEstimate estimate(std::uint64_t pixel, int channel) const;

  /// Calls visit(array) for the arrays of sums and numbers of paths.
  template <class Visit>
  void visit_state(const Visit& visit) {
    if (!exist()) return;
    sums_.visit(visit);
    visit(paths_);
  }
  /// Takes in what other paths left.
  void add(const Splats& other);

 private:
  /// The pixels along one axis that a splat counts for, and how much.
  struct Footprint {
    std::uint32_t first = 0;
    std::vector<double> weights;
  };
  void cover(double position, std::uint32_t size, Footprint& footprint) const;

  FilmSettings settings_;
  std::vector<float> filter_;
  Footprint columns_, rows_;
  ExactPlanes sums_;  ///< R, G, B of one replicate after the other, pixel by pixel
  std::array<std::uint64_t, kLightReplicates> paths_{};
};

}  // namespace norrsken
