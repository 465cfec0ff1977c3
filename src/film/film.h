// The film on the host: the memory of the sums, and what they say about the image and its error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/zeroed_array.h"
#include "film/exact_planes.h"
#include "film/interval.h"
#include "film/pixel_estimate.h"
#include "film/sample_set.h"
#include "film/splats.h"
#include "norrsken/image.h"
#include "norrsken/samples.h"
#include "tables/film_view.h"
#include "tables/layers.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// A rectangle of pixels.
struct FilmRegion {
  std::uint32_t x0 = 0, y0 = 0, width = 0, height = 0;
};

/// What lies in both.
FilmRegion intersection(const FilmRegion& a, const FilmRegion& b);

/// Totals over pixels and channels, for the error of the whole image.
struct FilmError {
  double mean_sum = 0;
  double square_sum = 0;  ///< of means
  // Of the pixel channels whose variance is known: their number, variances, those of one sample, and the squares of
  // variances, where those of a pixel's channels count as one.
  std::uint64_t channels = 0;
  double variance_sum = 0, sample_variance_sum = 0, variance_square_sum = 0;
  /// Pixel channels whose variance is not known yet.
  std::uint64_t pending = 0;
  /// Those whose variance will never be known, as samples of theirs were dropped: some have samples, their numbers'
  /// inverses added up here, and some have none.
  std::uint64_t lost = 0, empty = 0;
  double lost_inverse_samples = 0;
  /// Variances are spreads of two replicates. Where rare bright paths are most of the noise such spreads have longer tails
  /// than those of normal noise: the interval reckons with half of the pixels.
  bool of_two_replicates = false;

  /// `samples` are on the film, and those that were dropped are not.
  void add(const PixelEstimate (&channels_of_pixel)[3], std::uint32_t samples, bool some_dropped);
  void operator+=(const FilmError& other);
  /// sqrt(mean squared error) / mean, with the interval that holds the image's true one with a probability of 95 % or
  /// more; unknown as long as the variance of any channel is pending.
  RelativeError relative() const;
};

/// The layers of any scene's first hits: depth.Z, normal.X/Y/Z, albedo.R/G/B and id.
std::vector<FeatureLayer> standard_features();

/// Memory does not depend on the number of samples.
class Film {
 public:
  Film(const FilmSettings& settings, SamplerKind sampler, SceneLayers layers = {});

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  FilmView view();

  /// What paths from the lights leave is part of the image from then on.
  void add_splats(Splats splats) { splats_ = std::move(splats); }
  Splats& splats() { return splats_; }

  /// Which samples are taken; a pixel that has n of them has the first n.
  void set_samples(SampleSet samples) { samples_ = std::move(samples); }

  /// All that samples leave on the film, by name: what a checkpoint holds.
  struct State {
    const char* name;
    std::span<std::byte> bytes;
  };
  std::vector<State> state();
  /// As if nothing had been rendered.
  void clear();
  /// Takes in what a film of the same settings holds of other samples; exact (see base/exact_sum.h).
  void add(const Film& other);

  const FilmSettings& settings() const { return settings_; }
  const SceneLayers& layers() const { return layers_; }

  // Of one pixel.
  PixelEstimate estimate(std::uint64_t pixel, int channel) const;
  std::uint32_t samples(std::uint64_t pixel) const;
  /// The mean of X, Y or Z squared.
  double moment(std::size_t axis, std::uint64_t pixel) const;
  /// The mean over `samples` samples.
  double feature(Feature feature, std::uint64_t pixel, std::uint32_t samples) const;

  FilmError error(const FilmRegion& region) const;
  /// By which the variances of its pixels are moderated: those of two replicates more than others.
  const Neighbors& neighbors() const;

  /// All of it, while nobody writes to it: see film/film_image.h.
  Image image(bool statistics, std::uint32_t feature_samples) const;

 private:
  PixelEstimate estimate_samples(std::uint64_t pixel, int channel) const;
  /// That variances are told from: not from samples, nor from paths from the lights.
  bool has_two_replicates() const { return sampler_ != SamplerKind::independent && !splats_.exist(); }

  FilmSettings settings_;
  std::uint32_t width_, height_;
  SamplerKind sampler_;
  SceneLayers layers_;
  std::uint32_t feature_mask_ = 0;
  SampleSet samples_;
  ExactPlanes sums_, moments_, features_;
  ZeroedArray<std::uint32_t> counts_;
  Splats splats_;
};

}  // namespace norrsken
