#include "figures/equal_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace norrsken::cli {
namespace {

TEST(PredictSpp, OneMeasurementFollowsTheRateOfIndependentSamples) {
  EXPECT_EQ(predict_spp({{100, 0.02}}, 0.01), 400);
  EXPECT_EQ(predict_spp({{100, 0.02}}, 0.04), 25);
}

TEST(PredictSpp, TwoMeasurementsGiveTheRate) {
  // error = 1 / spp, faster than independent samples.
  EXPECT_EQ(predict_spp({{10, 0.1}, {100, 0.01}}, 0.001), 1000);
}

TEST(PredictSpp, ContradictingMeasurementsDoNotMislead) {
  // More samples with a greater error is noise of the measurement: the nearest one and the usual rate decide.
  EXPECT_EQ(predict_spp({{100, 0.020}, {110, 0.025}}, 0.01), 400);
}

TEST(PredictSpp, AtLeastOneSample) { EXPECT_EQ(predict_spp({{2, 0.01}}, 1), 1); }

TEST(FindEqualError, ConvergesOnALawItDoesNotKnow) {
  int calls = 0;
  const auto law = [&](int spp) {
    ++calls;
    return 0.4 * std::pow(spp, -0.5) + 0.3 * std::pow(spp, -0.8);
  };
  const double target = law(777);
  calls = 0;
  const SppError found = find_equal_error(target, {{10, law(10)}, {20, law(20)}}, law);
  EXPECT_LE(std::abs(found.error / target - 1), 0.05);
  EXPECT_NEAR(found.spp, 777, 80);
  EXPECT_LE(calls, 2 + 4);
}

TEST(FindEqualError, MeasuresNothingIfOneIsNearEnough) {
  const SppError found = find_equal_error(0.01, {{10, 0.03}, {90, 0.0103}}, [](int) -> double {
    ADD_FAILURE() << "measured without need";
    return 1;
  });
  EXPECT_EQ(found.spp, 90);
}

TEST(FindEqualError, StopsWhereWholeSamplesAllowNothingBetter) {
  int calls = 0;
  const auto law = [&](int spp) {
    ++calls;
    return 1 / std::sqrt(spp);
  };
  // Between the errors of 1 and 2 samples.
  const int spp = find_equal_error(0.82, {{1, 1.0}}, law).spp;
  EXPECT_TRUE(spp == 1 || spp == 2) << spp;
  EXPECT_LE(calls, 1);
}

}  // namespace
}  // namespace norrsken::cli
