// How many samples a rendering takes: a number, until an error is reached, or until time is up; everywhere alike, or more
// where there is more noise.
//
// Renderings by error, by time and adaptive ones go from goal to goal: when all samples of one are on the film, the
// schedule looks at it and sets the next. Goals by error depend on nothing but the samples, so the bits of the image do
// not depend on threads or interruptions.
#pragma once

#include <cstdint>
#include <optional>

#include "film/film.h"
#include "norrsken/render.h"
#include "render/work_plan.h"

namespace norrsken {

/// The number of samples that each tile is to have, and their mean over all pixels, at most.
struct SampleGoal {
  std::uint32_t mean = 0;
  TileProgress of_tile;
  bool is_step = false;  ///< set by a schedule that goes on from there

  /// The same everywhere.
  static SampleGoal uniform(const TileGrid& grid, std::uint32_t samples, bool is_step);
  std::uint32_t most() const;
  /// Samples in all.
  std::uint64_t total(const TileGrid& grid) const;
  /// The same, and nowhere fewer than `samples`.
  SampleGoal and_at_least(const TileProgress& samples) &&;
};

/// How much of a rendering is done, 0 to 1, and how long the rest will take; -1 while unknown.
struct Outlook {
  double fraction = 0, seconds_left = -1;
};

/// Whether an error or a time says when to end, rather than a number of samples.
inline bool is_open(const RenderOptions& options) { return options.target_error > 0 || options.seconds > 0; }
/// Whether a rendering goes from goal to goal.
inline bool goes_by_steps(const RenderOptions& options) { return is_open(options) || options.adaptive; }

class SampleSchedule {
 public:
  /// `most` samples per pixel, on average; the number to take if neither error nor time are given.
  SampleSchedule(const RenderOptions& options, std::uint32_t most);

  SampleGoal first(const TileGrid& grid) const;
  /// The goal after `reached`, all of which is on the film; nothing if the rendering is complete. `seconds` are those
  /// since the rendering began, in which it took `taken` samples per pixel.
  std::optional<SampleGoal> next(const TileGrid& grid, const Film& film, const SampleGoal& reached, double seconds,
                                 double taken) const;
  /// The goal of a rendering that was on the way to `stored` and has come so far; nothing if it has more samples than this
  /// one is to have.
  std::optional<SampleGoal> resume(const TileGrid& grid, const SampleGoal& stored, const TileProgress& progress) const;
  std::uint32_t most() const { return most_; }
  /// Whether there is no time left for anything.
  bool is_over(double seconds) const { return seconds_ > 0 && seconds >= seconds_; }
  /// `mean_samples` per pixel are on the film, of which `taken` in the `seconds` since the rendering began.
  Outlook outlook(double seconds, const RelativeError& error, double mean_samples, double taken) const;

 private:
  std::uint32_t next_mean(const FilmError& error, std::uint32_t reached, double seconds, double taken) const;

  std::uint32_t most_;
  double target_error_, seconds_;
  bool adaptive_, by_steps_;
};

/// More samples, for tiles of 16 pixels. Half of them are spread evenly, which bounds what can be lost where noise is not
/// foreseen: nowhere is the variance more than twice that of even samples. The other half follows Neyman's allocation (1934;
/// Cochran, Sampling Techniques, 5.5): in proportion to the standard deviation of one sample. That deviation is one of the
/// tiles around, the row of pixels above and below first of all, and never of the tile itself: a number of samples that
/// depended on their values would pull the image down where dark samples came first (Kirk and Arvo, Unbiased Sampling
/// Techniques for Image Synthesis, 1991). Tiles are in groups: where the other groups do not show, beyond chance, that this
/// leaves less noise than even samples, a group's tiles get as many as if all were even. What a tile has is still felt
/// through the budget that all share, the less the more tiles there are; with few, all get the same. No tile loses what it has.
SampleGoal allocate_samples(const TileGrid& grid, const Film& film, const SampleGoal& reached, std::uint32_t mean);

}  // namespace norrsken
