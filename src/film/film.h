// The film on the host: the memory of the sums, and what they say about the image and its error.
#pragma once

#include <cstdint>
#include <utility>

#include "base/aligned.h"
#include "film/splats.h"
#include "norrsken/image.h"
#include "tables/film_view.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// A rectangle of pixels.
struct FilmRegion {
  std::uint32_t x0 = 0, y0 = 0, width = 0, height = 0;
};

/// Totals over pixels and channels, for the error of the whole image.
struct FilmError {
  double mean_sum = 0, variance_sum = 0;
  std::uint64_t channels = 0;  ///< pixel channels whose variance is known

  void operator+=(const FilmError& other);
  /// sqrt(mean variance) / mean; -1 if nothing is known yet.
  double relative() const;
};

/// Memory does not depend on the number of samples.
class Film {
 public:
  Film(const FilmSettings& settings, SamplerKind sampler, bool features);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  FilmView view();

  /// What paths from the lights leave is part of the image from then on.
  void add_splats(Splats splats) { splats_ = std::move(splats); }
  Splats& splats() { return splats_; }

  PixelEstimate estimate(std::uint64_t pixel, int channel) const;
  FilmError error(const FilmRegion& region) const;

  /// R, G, B; with `layers` also samples, variance.*, error.*, and the features divided by `feature_samples` if any.
  Image image(bool layers, std::uint32_t feature_samples) const;

 private:
  PixelEstimate estimate_samples(std::uint64_t pixel, int channel) const;

  std::uint32_t width_, height_;
  bool weighted_;
  SamplerKind sampler_;
  // Tiles are a multiple of a cache line wide: aligned, two threads on neighbouring tiles never write to one line.
  AlignedVector<double> sums_;
  AlignedVector<std::uint32_t> counts_;
  AlignedVector<float> features_;
  Splats splats_;
};

}  // namespace norrsken
