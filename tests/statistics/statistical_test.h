// The statistical comparisons of one GoogleTest, at the level that the suite as a whole leaves to each of them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <string>

#include "tests/statistics/estimate.h"
#include "tests/statistics/judge.h"
#include "tests/statistics/sampling.h"

namespace norrsken::statistics {

/// Collects pairs of values, of a tested quantity and of its reference, that need not be independent of each other.
class PairedMeans {
 public:
  void add(double tested, double reference) {
    tested_.add(tested), reference_.add(reference), difference_.add(tested - reference);
  }
  Estimate tested() const { return tested_.estimate(); }
  Estimate reference() const { return reference_.estimate(); }
  Estimate difference() const { return difference_.estimate(); }

 private:
  Mean tested_, reference_, difference_;
};

/// One per test, which is entered in suite.h under its name with the number of its comparisons (and, if it has several
/// instances, with how many they are). Comparisons that turn out to have no object are declared by `skip`. When it goes
/// out of scope the test fails unless the numbers are those entered.
class StatisticalTest {
 public:
  /// Of the running test.
  StatisticalTest();
  /// Of an entry that is no test's name, and fails nothing by itself: for tests of tests.
  explicit StatisticalTest(const std::string& family);
  StatisticalTest(const StatisticalTest&) = delete;
  StatisticalTest& operator=(const StatisticalTest&) = delete;
  ~StatisticalTest();

  /// Samples against their density: whether they are where it says (by chi-square, with a plot if not), and whether as
  /// many come as its integral says, which the result tells. `what` is model, parameters, angle. Two comparisons.
  ::testing::AssertionResult follows_density(const Sampling& sampling, const std::string& what);

  /// Counts against what is expected of them, by chi-square, with a plot if they disagree. One comparison.
  ::testing::AssertionResult chi_square(std::span<const Cell> cells, const std::array<std::string, 2>& axes,
                                        const std::string& what);

  /// Two means, by Welch's test. `rounding` is the relative error that is no bias: single precision, or quadrature.
  ::testing::AssertionResult agree(const Estimate& tested, const Estimate& reference, const std::string& what,
                                   double rounding = 0);
  ::testing::AssertionResult agree(const Estimate& tested, double reference, const std::string& what,
                                   double rounding = 0) {
    return agree(tested, Estimate::known(reference), what, rounding);
  }
  /// The same of two means that are known so well that a bias of `resolution`, relative to the reference, is seen.
  ::testing::AssertionResult agree_to(double resolution, const Estimate& tested, const Estimate& reference,
                                      const std::string& what);
  /// Likewise of two quantities that were drawn in pairs, by the mean of their differences.
  ::testing::AssertionResult agree_to(double resolution, const PairedMeans& pairs, const std::string& what);
  /// A mean that must not exceed a limit.
  ::testing::AssertionResult at_most(const Estimate& tested, double limit, const std::string& what,
                                     double rounding = 0);
  /// Pairs of numbers with nothing to do with each other, by their coefficient of correlation.
  ::testing::AssertionResult uncorrelated(std::span<const double> x, std::span<const double> y,
                                          const std::string& what);

  void skip(int comparisons) { made_ += comparisons; }

  int made() const { return made_; }
  int planned() const { return planned_; }
  double level() const { return level_; }

 private:
  ::testing::AssertionResult verdict(const Comparison& comparison, const Estimate& tested, const Estimate& reference,
                                     const std::string& what) const;

  std::string name_;
  int planned_, made_ = 0;
  double level_;
  bool reports_;
};

/// How far the integral of a density in single precision, by quadrature, may be off.
inline constexpr double kQuadratureError = 2e-4;

}  // namespace norrsken::statistics
