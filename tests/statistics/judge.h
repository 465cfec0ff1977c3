// Decides whether estimates agree, and says how small a disagreement it would have noticed.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "tests/statistics/estimate.h"

namespace norrsken::statistics {

/// Welch's test of one pair of estimates.
struct Comparison {
  std::string sort, name;
  double difference = 0;     ///< tested minus reference
  double sigmas = 0;         ///< the difference in standard errors, after allowing for rounding
  double critical = 0;       ///< beyond so many standard errors the pair is rejected
  double smallest_bias = 0;  ///< relative to the reference: one so large would have been rejected in 97.7 % of cases
  double resolution = 0;     ///< what `smallest_bias` has to reach

  bool agrees() const { return !(std::abs(sigmas) > critical); }
  bool resolves() const { return !(smallest_bias > resolution); }
};

/// Compares at significance `level`. `rounding` is the relative error of the tested side that is no bias: what
/// single precision costs.
Comparison compare(const Estimate& tested, const Estimate& reference, double resolution, double level, double rounding);

/// The same for an estimate of the difference of two that were drawn in pairs; `reference` tells its scale.
Comparison compare_paired(const Estimate& difference, double reference, double resolution, double level,
                          double rounding);

/// Gathers the comparisons of one test. The suite as a whole falsely rejects with probability 1 %, so each family of
/// comparisons is entered with its size in suite.h.
class Judge {
 public:
  /// Single precision radiance along a short path; far below any bias worth finding.
  static constexpr double kRounding = 2e-5;

  explicit Judge(std::string_view family);

  /// Every region and channel of two images. `what` precedes the regions' names; the tested side's say what has to be
  /// resolved.
  void compare(const std::string& what, const RegionEstimates& tested, const RegionEstimates& reference);
  /// The same for replicates that share their random numbers pair by pair.
  void compare_paired(const std::string& what, const RegionMeans& tested, const RegionMeans& reference);

  /// Prints the smallest biases this judge could have seen; fails if any pair disagrees (naming it, and by how many
  /// standard errors), if a comparison was too coarse, or if their number is not the one in suite.h.
  ::testing::AssertionResult verdict() const;

 private:
  void add(const std::string& what, const Region& region, std::size_t channel, Comparison comparison);

  std::string family_;
  int planned_ = 0;
  double level_ = 0;
  std::vector<Comparison> comparisons_;
};

}  // namespace norrsken::statistics
