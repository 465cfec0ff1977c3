#include "render/sample_schedule.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <utility>

namespace norrsken {
namespace {

/// Whole waves of samples, and whole sets of replicates where there is no time for those.
constexpr std::uint32_t kBlock = 16, kSmallBlock = kReplicates;

/// With fewer tiles a tile's own noise would be felt in its own number of samples.
constexpr std::size_t kFewestTiles = 64;
/// No tile gets more than so many times the mean: spots of noise must not draw all samples to their surroundings.
constexpr std::uint32_t kGreatestShare = 16;
/// So many times its standard error has to be gained by uneven samples, or they are even.
constexpr double kSureGain = 0.5;

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

/// The neighbours of a tile by how many rows of tiles they are away, in its own column of tiles and in those beside it.
constexpr double kRowWeights[] = {0.3, 1, 0.5};
constexpr double kBesideWeight = 0.2;

/// Each tile's deviation of one sample, from the mean variance of those around it; negative variances are left out.
std::vector<double> deviations_around(const TileGrid& grid, const std::vector<double>& variances) {
  const auto columns = static_cast<std::int64_t>(grid.columns), rows = static_cast<std::int64_t>(grid.rows);
  constexpr std::int64_t kReach = std::size(kRowWeights) - 1;
  std::vector<double> deviations(variances.size());
  for (std::int64_t y = 0; y < rows; ++y) {
    for (std::int64_t x = 0; x < columns; ++x) {
      double variance = 0, weights = 0;
      for (std::int64_t v = std::max<std::int64_t>(y - kReach, 0); v <= std::min(y + kReach, rows - 1); ++v) {
        for (std::int64_t u = std::max<std::int64_t>(x - 1, 0); u <= std::min(x + 1, columns - 1); ++u) {
          const auto other = static_cast<std::size_t>(v * columns + u);
          if ((u == x && v == y) || variances[other] < 0) continue;
          const double weight =
              static_cast<double>(grid.pixels_of(other)) * kRowWeights[std::abs(v - y)] * (u == x ? 1 : kBesideWeight);
          variance += weight * variances[other];
          weights += weight;
        }
      }
      if (weights > 0) deviations[static_cast<std::size_t>(y * columns + x)] = std::sqrt(variance / weights);
    }
  }
  return deviations;
}

/// As many samples as fit the budget, for the tiles that are uneven in proportion to the mean deviation plus their own.
TileProgress allocate(const TileGrid& grid, const SampleGoal& reached, std::uint32_t mean,
                      const std::vector<double>& deviations, const std::vector<bool>& is_uneven) {
  const std::size_t tiles = deviations.size();
  double budget = 0, deviation_sum = 0, pixels = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const auto of_tile = static_cast<double>(grid.pixels_of(tile));
    pixels += of_tile;
    budget += of_tile * mean;
    deviation_sum += of_tile * deviations[tile];
  }
  if (!(deviation_sum > 0)) return SampleGoal::uniform(grid, mean, true).and_at_least(reached.of_tile).of_tile;
  const double mean_deviation = deviation_sum / pixels;
  const double most = std::min(static_cast<double>(kGreatestShare) * mean, 1e9);
  const auto share = [&](std::size_t tile, double scale) {
    const double part = mean_deviation + (is_uneven[tile] ? deviations[tile] : mean_deviation);
    const auto samples = static_cast<std::uint32_t>(std::min(scale * part, most));
    return std::max(reached.of_tile[tile], round_down(samples + kBlock / 2, kBlock));
  };
  // The greatest scale whose samples are no more than asked for.
  const auto cost = [&](double scale) {
    double samples = 0;
    for (std::size_t tile = 0; tile < tiles; ++tile)
      samples += static_cast<double>(grid.pixels_of(tile)) * share(tile, scale);
    return samples;
  };
  double low = 0, high = mean / mean_deviation;
  while (cost(high) < budget && high < 1e300) high *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (cost(middle) <= budget ? low : high) = middle;
  }
  TileProgress samples(tiles);
  for (std::size_t tile = 0; tile < tiles; ++tile) samples[tile] = share(tile, low);
  return samples;
}

/// Whether it is sure that uneven samples leave less variance than `even` ones, by those tiles whose variance is not
/// negative. It is not their own that their numbers follow, so that the gain is right on average; its error is that of its
/// terms, which are independent. Where noise is of rare and bright paths, few tiles carry all of it: nothing is sure.
bool is_sure_of_gain(const TileGrid& grid, const std::vector<double>& variances, const TileProgress& even,
                     const TileProgress& uneven) {
  double sum = 0, squares = 0;
  for (std::size_t tile = 0; tile < variances.size(); ++tile) {
    if (variances[tile] < 0) continue;
    const double variance = static_cast<double>(grid.pixels_of(tile)) * variances[tile];
    const double gain = variance / even[tile] - variance / uneven[tile];
    sum += gain;
    squares += gain * gain;
  }
  return sum > kSureGain * std::sqrt(squares);
}

/// The group of a tile, of which no two are in each other's way: whether to trust noise is decided for each by the others.
constexpr std::size_t kGroups = 8;
std::size_t group_of(const TileGrid& grid, std::size_t tile) {
  return (tile % grid.columns + 3 * (tile / grid.columns)) % kGroups;
}

}  // namespace

SampleGoal allocate_samples(const TileGrid& grid, const Film& film, const SampleGoal& reached, std::uint32_t mean) {
  const std::size_t tiles = grid.tile_count();
  if (tiles < kFewestTiles) return SampleGoal::uniform(grid, mean, true).and_at_least(reached.of_tile);
  std::vector<double> variances(tiles);
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const FilmError error = film.error(grid.region_of(tile));
    if (error.channels > 0) variances[tile] = error.sample_variance_sum / static_cast<double>(error.channels);
  }
  const std::vector<double> deviations = deviations_around(grid, variances);
  const std::vector<bool> none(tiles, false), all(tiles, true);
  const bool is_even_so_far = std::ranges::adjacent_find(reached.of_tile, std::not_equal_to{}) == reached.of_tile.end();
  const TileProgress even =
      is_even_so_far ? TileProgress(tiles, mean) : allocate(grid, reached, mean, deviations, none);
  bool sure[kGroups];
  for (std::size_t group = 0; group < kGroups; ++group) {
    std::vector<double> of_others = variances;
    for (std::size_t tile = 0; tile < tiles; ++tile)
      if (group_of(grid, tile) == group) of_others[tile] = -1;
    sure[group] =
        is_sure_of_gain(grid, of_others, even, allocate(grid, reached, mean, deviations_around(grid, of_others), all));
  }
  std::vector<bool> is_uneven(tiles);
  for (std::size_t tile = 0; tile < tiles; ++tile) is_uneven[tile] = sure[group_of(grid, tile)];
  return {mean, is_uneven == none ? even : allocate(grid, reached, mean, deviations, is_uneven), true};
}

}  // namespace norrsken
