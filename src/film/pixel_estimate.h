// What a pixel's samples say about its value.
#pragma once

#include <cstddef>

namespace norrsken {

/// Mean and variance of the mean of one pixel's channel.
struct PixelEstimate {
  double mean = 0;
  double variance = 0;  ///< of the mean; meaningful if `known`
  bool known = false;   ///< false while there are fewer than two independent estimates
};

/// From the sums of independent replicates and how many samples are in each: the spread of the replicates' means, each
/// weighted with its share of the samples. For samples of variance v the sum of the n_r^2 (mean of r - mean)^2 is
/// v (n - sum of n_r^2 / n) on average, of which this makes v / n.
template <std::size_t Replicates>
PixelEstimate estimate_from_replicates(const double (&sums)[Replicates], const double (&counts)[Replicates]) {
  double total = 0, count = 0, squares = 0;
  for (std::size_t r = 0; r < Replicates; ++r) {
    total += sums[r];
    count += counts[r];
    squares += counts[r] * counts[r];
  }
  if (!(count > 0)) return {};
  const double mean = total / count;
  if (squares == count * count) return {mean, 0, false};  // all in one
  double spread = 0;
  for (std::size_t r = 0; r < Replicates; ++r) {
    const double deviation = sums[r] - counts[r] * mean;  // count * (mean of r - mean)
    spread += deviation * deviation;
  }
  return {mean, spread / (count * count - squares), true};
}

}  // namespace norrsken
