// The judge itself: its distributions against tables, its error rates against synthetic data.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/statistics/judge.h"
#include "tests/statistics/statistical_test.h"
#include "tests/statistics/student.h"
#include "tests/statistics/suite.h"

namespace norrsken::statistics {
namespace {

TEST(Student, MatchesPublishedQuantiles) {
  // Two-sided critical values as in any table of the t distribution.
  EXPECT_NEAR(student_critical(0.05, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_critical(0.05, 10), 2.228, 5e-4);
  EXPECT_NEAR(student_critical(0.01, 30), 2.750, 5e-4);
  EXPECT_NEAR(student_critical(0.001, 60), 3.460, 5e-4);
  EXPECT_NEAR(student_critical(0.01, 1e7), 2.5758, 5e-4);  // the normal distribution
}

TEST(Student, HasClosedFormsForOneAndTwoDegreesOfFreedom) {
  for (const double t : {0.1, 1.0, 3.0, 20.0}) {
    EXPECT_NEAR(student_two_sided(t, 1), 1 - 2 / M_PI * std::atan(t), 1e-12);
    EXPECT_NEAR(student_two_sided(t, 2), 1 - t / std::sqrt(2 + t * t), 1e-12);
  }
  EXPECT_DOUBLE_EQ(student_two_sided(0, 7.5), 1);
}

TEST(Student, CriticalValueInvertsTheTail) {
  for (const double level : {0.3, 1e-2, 1e-6}) {
    for (const double freedom : {3.5, 31.0, 200.0}) {
      EXPECT_NEAR(student_two_sided(student_critical(level, freedom), freedom) / level, 1, 1e-9);
    }
  }
}

TEST(Sidak, AllTestsTogetherHaveTheLevel) {
  EXPECT_DOUBLE_EQ(sidak_level(0.01, 1), 0.01);
  EXPECT_NEAR(std::pow(1 - sidak_level(0.01, 500), 500), 0.99, 1e-12);
}

TEST(EstimateFromReplicates, IsMeanAndVarianceOfTheMean) {
  const std::array<double, 4> values = {1, 2, 3, 6};
  const Estimate estimate = Estimate::from_replicates(values);
  EXPECT_DOUBLE_EQ(estimate.mean, 3);
  EXPECT_DOUBLE_EQ(estimate.variance, 14.0 / 3 / 4);
  EXPECT_EQ(estimate.replicates, 4);
}

TEST(RegionMeans, AveragesTheRightPixels) {
  Picture picture(4, 4);
  picture.at(3, 0) = {16, 0, 0};  // top right
  picture.at(0, 3) = {0, 32, 0};  // bottom left
  RegionMeans means(regions_of(4, 4, std::array{Grid{1, 1, 1}, Grid{2, 2, 1}}));
  means.add(picture);
  means.add(picture);
  const RegionEstimates estimates = means.estimates();
  EXPECT_DOUBLE_EQ(estimates.values[0][0].mean, 1);
  EXPECT_DOUBLE_EQ(estimates.values[0][1].mean, 2);
  EXPECT_EQ(estimates.regions[2].name, "block (1,0) of 2 x 2");
  EXPECT_DOUBLE_EQ(estimates.values[2][0].mean, 4);
  EXPECT_DOUBLE_EQ(estimates.values[3][1].mean, 8);
  EXPECT_DOUBLE_EQ(estimates.values[1][0].mean, 0);
}

/// Replicates of a skewed quantity of mean 1 and the given relative error: averages of 100 exponential variables, a
/// fair likeness of a region's mean.
Estimate noisy_estimate(std::mt19937_64& random, int replicates, double relative_error, double bias) {
  std::gamma_distribution<double> average(100, 0.01);  // mean 1, standard deviation 0.1
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(replicates));
  for (int i = 0; i < replicates; ++i) {
    values.push_back((1 + bias) * (1 + 10 * relative_error * std::sqrt(replicates) * (average(random) - 1)));
  }
  return Estimate::from_replicates(values);
}

constexpr double kError = 0.0007;

/// Share of experiments in which two estimates of 0.07 % error each, one of them biased, are found to disagree.
double rejected_share(double bias, double level, int experiments) {
  std::mt19937_64 random(11);
  int rejected = 0;
  for (int i = 0; i < experiments; ++i) {
    const Estimate tested = noisy_estimate(random, 24, kError, bias);
    const Estimate reference = noisy_estimate(random, 32, kError, 0);
    rejected += compare(tested, reference, 1, level, 0).agrees() ? 0 : 1;
  }
  return static_cast<double>(rejected) / experiments;
}

TEST(Judging, AcceptsUnbiasedDataAtTheNominalRate) {
  constexpr int kExperiments = 20000;
  StatisticalTest test;
  for (const double level : {0.05, 0.01}) {
    const double variance = level * (1 - level) / kExperiments;
    EXPECT_TRUE(test.agree({rejected_share(0, level, kExperiments), variance, kExperiments}, level, "rejected share"));
  }
}

TEST(Judging, RejectsABiasOfOnePercent) {
  EXPECT_EQ(rejected_share(0.01, sidak_level(kSuiteLevel, suite_comparisons()), 300), 1);
  EXPECT_EQ(rejected_share(-0.01, sidak_level(kSuiteLevel, suite_comparisons()), 300), 1);
}

TEST(Judging, SeesTheBiasThatItClaimsToSee) {
  const double level = sidak_level(kSuiteLevel, suite_comparisons());
  std::mt19937_64 random(5);
  double claimed = 0;
  for (int i = 0; i < 200; ++i) {
    claimed += compare(noisy_estimate(random, 24, kError, 0), noisy_estimate(random, 32, kError, 0), 1, level, 0)
                   .smallest_bias /
               200;
  }
  EXPECT_LT(claimed, 0.01);
  EXPECT_GT(rejected_share(claimed, level, 2000), 0.95);
  EXPECT_LT(rejected_share(claimed / 2, level, 2000), 0.2);
}

TEST(Judging, AllowsForRoundingButNoMore) {
  EXPECT_TRUE(compare({1.00001, 0, 4}, Estimate::known(1), 1, 0.01, 2e-5).agrees());
  EXPECT_FALSE(compare({1.00003, 0, 4}, Estimate::known(1), 1, 0.01, 2e-5).agrees());
  EXPECT_FALSE(compare({1e-30, 0, 4}, Estimate::known(0), 1, 0.01, 2e-5).agrees());
  EXPECT_TRUE(compare({0, 0, 4}, Estimate::known(0), 1, 0.01, 2e-5).agrees());
}

TEST(Judging, NotANumberDisagrees) {
  EXPECT_FALSE(compare({std::nan(""), 0, 4}, Estimate::known(1), 1, 0.01, 2e-5).agrees());
  EXPECT_FALSE(compare({std::nan(""), std::nan(""), 4}, Estimate::known(1), 1, 0.01, 2e-5).agrees());
}

/// Replicates of a picture of mean 1 with a relative error of `noise` per pixel and a bias in one block.
RegionMeans synthetic(double noise, double bias_of_a_block, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(1, noise);
  RegionMeans means(standard_regions(16, 16));
  for (int i = 0; i < 32; ++i) {
    Picture picture(16, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const double factor = x >= 12 && y < 4 ? 1 + bias_of_a_block : 1;
        picture.at(x, y) = {normal(random) * factor, normal(random), normal(random)};
      }
    }
    means.add(picture);
  }
  return means;
}

std::string verdict_on(double noise, double bias) {
  Judge judge("judge.synthetic");
  judge.compare("synthetic", synthetic(noise, bias, 1).estimates(), synthetic(noise, 0, 2).estimates());
  const auto verdict = judge.verdict();
  return verdict ? "agrees" : verdict.message();
}

TEST(Judging, VerdictNamesTheBiasedRegion) {
  EXPECT_EQ(verdict_on(0.01, 0), "agrees");
  const std::string complaint = verdict_on(0.01, 0.01);
  EXPECT_NE(complaint.find("synthetic: block (3,0) of 4 x 4, R: off by"), std::string::npos) << complaint;
  EXPECT_EQ(complaint.find(", G: off by"), std::string::npos) << complaint;
}

TEST(Judging, PairsSeeWhatIndependentImagesCannot) {
  // A noise of 10 % that both sides share hides a bias of 0.1 % from the one judge, not from the other.
  Judge paired("judge.synthetic");
  paired.compare_paired("", synthetic(0.1, 0.001, 1), synthetic(0.1, 0, 1));
  const auto verdict = paired.verdict();
  ASSERT_FALSE(verdict);
  EXPECT_NE(std::string(verdict.message()).find("block (3,0) of 4 x 4, R: off by"), std::string::npos);
  EXPECT_EQ(std::string(verdict.message()).find("could have seen"), std::string::npos);
  EXPECT_EQ(verdict_on(0.1, 0.001).find("off by"), std::string::npos);
}

TEST(Judging, VerdictRefusesAComparisonThatIsTooCoarse) {
  const std::string complaint = verdict_on(0.1, 0);
  EXPECT_NE(complaint.find("could have seen a bias of"), std::string::npos) << complaint;
}

TEST(Judging, VerdictRefusesAnUnplannedNumberOfComparisons) {
  Judge judge("judge.synthetic");
  EXPECT_FALSE(judge.verdict());
  EXPECT_THROW(Judge("no such family"), std::invalid_argument);
}

}  // namespace
}  // namespace norrsken::statistics
