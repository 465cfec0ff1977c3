#include "render/schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace norrsken {
namespace {

/// Whole waves of samples, and whole sets of replicates where there is no time for those.
constexpr std::uint32_t kBlock = 16, kSmallBlock = kReplicates;

/// With fewer regions a region's own noise would be felt in its own number of samples.
constexpr std::size_t kFewestRegions = 64;
/// No region gets more than so many times the mean: spots of noise must not draw all samples to their surroundings.
constexpr std::uint32_t kGreatestShare = 16;

/// Of what a prediction says, so that it comes true.
constexpr double kTimeMargin = 0.97;

/// A black image has no relative error; so many samples per pixel without any light are enough.
constexpr std::uint32_t kDarkSamples = 1024;

std::uint32_t round_down(std::uint32_t samples, std::uint32_t block) { return samples / block * block; }

}  // namespace

SampleGoal SampleGoal::uniform(const TileGrid& grid, std::uint32_t samples, bool is_step) {
  return {samples, TileProgress(grid.tile_count(), samples), is_step};
}

std::uint32_t SampleGoal::most() const { return of_tile.empty() ? 0 : *std::ranges::max_element(of_tile); }

std::uint64_t SampleGoal::total(const TileGrid& grid) const {
  std::uint64_t sum = 0;
  for (std::size_t tile = 0; tile < of_tile.size(); ++tile) sum += of_tile[tile] * grid.pixels_of(tile);
  return sum;
}

SampleGoal SampleGoal::and_at_least(const TileProgress& samples) && {
  for (std::size_t tile = 0; tile < of_tile.size(); ++tile) of_tile[tile] = std::max(of_tile[tile], samples[tile]);
  return std::move(*this);
}

SampleSchedule::SampleSchedule(const RenderOptions& options, std::uint32_t most)
    : most_(most),
      target_error_(options.target_error),
      seconds_(options.seconds),
      adaptive_(options.adaptive),
      by_steps_(goes_by_steps(options)) {}

SampleGoal SampleSchedule::first(const TileGrid& grid) const {
  if (!by_steps_) return SampleGoal::uniform(grid, most_, false);
  // How long a sample takes is not known before there is one.
  return SampleGoal::uniform(grid, std::min(most_, seconds_ > 0 ? 1 : kBlock), true);
}

std::uint32_t SampleSchedule::next_mean(const FilmError& error, std::uint32_t reached, double seconds,
                                        double taken) const {
  // At most twice as many: predictions are made again when more is known.
  std::uint32_t mean = static_cast<std::uint32_t>(std::min<std::uint64_t>(2 * std::uint64_t{reached}, most_));
  if (target_error_ > 0) {
    const RelativeError now = error.relative();
    // The upper end, so that the true error is as small as that, too.
    if (now.value >= 0 ? now.high <= target_error_ : reached >= kDarkSamples) return reached;
    const double ratio = now.value > 0 ? now.high / target_error_ : 2;
    const double needed = std::ceil(reached * ratio * ratio / kBlock) * kBlock;
    if (needed < mean) mean = std::max(static_cast<std::uint32_t>(needed), reached + 1);
  }
  if (mean < most_) mean = std::min((mean + kBlock - 1) / kBlock * kBlock, most_);
  if (seconds_ > 0 && !(taken > 0)) mean = std::min(mean, reached + kSmallBlock);
  if (seconds_ > 0 && taken > 0) {
    const double fitting = reached + kTimeMargin * (seconds_ - seconds) / (seconds / taken);
    if (fitting < mean) {
      const auto fits = static_cast<std::uint32_t>(std::max(fitting, 0.0));
      mean = round_down(fits, kBlock);
      if (mean <= reached) mean = round_down(fits, kSmallBlock);
      if (mean <= reached) mean = fits;
    }
  }
  return std::max(mean, reached);
}

std::optional<SampleGoal> SampleSchedule::next(const TileGrid& grid, const Film& film, const SampleGoal& reached,
                                               double seconds, double taken) const {
  if (!by_steps_ || reached.mean >= most_ || is_over(seconds)) return {};
  const FilmError error = target_error_ > 0 ? film.error({0, 0, film.width(), film.height()}) : FilmError{};
  const std::uint32_t mean = next_mean(error, reached.mean, seconds, taken);
  if (mean <= reached.mean) return {};
  if (adaptive_ && reached.mean >= kBlock) {  // the first samples say too little
    SampleGoal goal = allocate_samples(grid, film, reached, mean);
    if (goal.of_tile != reached.of_tile) return goal;
  }
  // Also where no noise has been seen yet, which may be because it is rare.
  return SampleGoal::uniform(grid, mean, true).and_at_least(reached.of_tile);
}

std::optional<SampleGoal> SampleSchedule::resume(const TileGrid& grid, const SampleGoal& stored,
                                                 const TileProgress& progress) const {
  const std::uint32_t done = progress.empty() ? 0 : *std::ranges::max_element(progress);
  // Time is only heeded when every pixel has a sample.
  if (seconds_ > 0 && std::ranges::find(progress, 0u) != progress.end()) return first(grid).and_at_least(progress);
  if (by_steps_ && stored.is_step && stored.mean <= most_) return stored;
  if (done > most_) return {};
  // A rendering of a given number of samples may have been left far from its end.
  const std::uint32_t begun = std::min((done + kBlock - 1) / kBlock * kBlock, most_);
  return by_steps_ && done > 0 ? SampleGoal::uniform(grid, begun, true) : first(grid);
}

Outlook SampleSchedule::outlook(double seconds, const RelativeError& error, double mean_samples, double taken) const {
  Outlook outlook;
  const auto may_end = [&](double fraction, double seconds_left) {
    outlook.fraction = std::max(outlook.fraction, std::min(fraction, 1.0));
    if (outlook.seconds_left < 0 || seconds_left < outlook.seconds_left) outlook.seconds_left = seconds_left;
  };
  // What is left takes as long for each sample as what was taken.
  const auto may_end_with = [&](double samples) {
    if (taken > 0) may_end(mean_samples / samples, std::max(samples - mean_samples, 0.0) * seconds / taken);
  };
  may_end_with(most_);
  if (target_error_ > 0 && error.value > 0) may_end_with(mean_samples * std::pow(error.high / target_error_, 2));
  if (seconds_ > 0) may_end(seconds / seconds_, std::max(seconds_ - seconds, 0.0));
  return outlook;
}

namespace {

/// Tiles whose waves are the same: those are given samples together.
struct Region {
  double pixels = 0, variance = 0;
  std::uint32_t floor = 0;  ///< samples that it will have anyway
  double deviation = 0;     ///< of one sample, after its neighbours
};

/// Regions up to so many columns and rows away; they are 16 x 4 pixels.
constexpr std::int64_t kReachX = 1, kReachY = 4;

/// Each region's deviation from the mean variance of those around it.
void set_deviations(std::vector<Region>& regions, std::int64_t columns) {
  const std::int64_t rows = static_cast<std::int64_t>(regions.size()) / columns;
  for (std::int64_t y = 0; y < rows; ++y) {
    for (std::int64_t x = 0; x < columns; ++x) {
      double variance = 0, pixels = 0;
      for (std::int64_t v = std::max<std::int64_t>(y - kReachY, 0); v <= std::min(y + kReachY, rows - 1); ++v) {
        for (std::int64_t u = std::max<std::int64_t>(x - kReachX, 0); u <= std::min(x + kReachX, columns - 1); ++u) {
          if (u == x && v == y) continue;
          const Region& other = regions[static_cast<std::size_t>(v * columns + u)];
          variance += other.variance * other.pixels;
          pixels += other.pixels;
        }
      }
      regions[static_cast<std::size_t>(y * columns + x)].deviation = pixels > 0 ? std::sqrt(variance / pixels) : 0;
    }
  }
}

std::uint32_t share(const Region& region, double scale, double most) {
  const double samples = std::min(scale * region.deviation, most);
  return std::max(region.floor, round_down(static_cast<std::uint32_t>(samples), kBlock));
}

}  // namespace

SampleGoal allocate_samples(const TileGrid& grid, const Film& film, const SampleGoal& reached, std::uint32_t mean) {
  const WorkPlan plan(grid, {kBlock, std::numeric_limits<std::uint32_t>::max()}, 0);
  std::vector<Region> regions(plan.area_count());
  double budget = 0;
  for (std::uint64_t i = 0; i < plan.area_count(); ++i) {
    const WaveJob job = plan.wave(i);
    const FilmError error = film.error({job.x0, job.y0, job.width, job.height});
    const std::uint32_t samples = plan.progress_of(i, reached.of_tile);
    Region& region = regions[i];
    region.pixels = job.pixel_count();
    if (error.channels > 0) region.variance = samples * error.variance_sum / static_cast<double>(error.channels);
    region.floor = std::max(samples, round_down(mean / 4, kBlock));
    budget += region.pixels * mean;
  }
  if (regions.size() < kFewestRegions) return SampleGoal::uniform(grid, mean, true).and_at_least(reached.of_tile);
  set_deviations(regions, plan.areas_per_row());
  const double most = std::min(static_cast<double>(kGreatestShare) * mean, 1e9);

  // The greatest scale whose samples are no more than asked for.
  const auto cost = [&](double scale) {
    double samples = 0;
    for (const Region& region : regions) samples += region.pixels * share(region, scale, most);
    return samples;
  };
  double low = 0, high = 1;
  while (cost(high) < budget && high < 1e30) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (cost(middle) <= budget ? low : high) = middle;
  }
  SampleGoal goal{mean, reached.of_tile, true};
  for (std::uint64_t i = 0; i < plan.area_count(); ++i)
    plan.set_progress_of(i, share(regions[i], low, most), goal.of_tile);
  return goal;
}

}  // namespace norrsken
