// What a pixel's samples say about its value.
#pragma once

#include "tables/wave_types.h"

namespace norrsken {

/// Mean and variance of the mean of one pixel's channel.
struct PixelEstimate {
  double mean = 0;
  double variance = 0;            ///< of the mean; meaningful if `known`
  bool known = false;             ///< false while there are fewer than two independent estimates
  double degrees_of_freedom = 0;  ///< of the variance
};

/// From the sums of independent replicates and how many samples are in each: the spread of the replicates' means, each
/// weighted with its share of the samples.
inline PixelEstimate estimate_from_replicates(const double (&sums)[kReplicates], const double (&counts)[kReplicates]) {
  double total = 0, count = 0;
  for (std::uint32_t r = 0; r < kReplicates; ++r) total += sums[r], count += counts[r];
  if (!(count > 0)) return {};
  const double mean = total / count;
  double spread = 0, replicates = 0;
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    if (counts[r] == 0) continue;
    const double deviation = sums[r] - counts[r] * mean;  // count * (mean of r - mean)
    spread += deviation * deviation;
    ++replicates;
  }
  if (replicates < 2) return {mean, 0, false};
  return {mean, spread / (count * count) * replicates / (replicates - 1), true, replicates - 1};
}

}  // namespace norrsken
