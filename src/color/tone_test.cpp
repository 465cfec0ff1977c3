#include "color/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "color/srgb.h"

namespace norrsken {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(FilmicCurve, HasTheValuesOfItsFormula) {
  EXPECT_EQ(filmic_curve(0), 0);
  EXPECT_NEAR(filmic_curve(1), 2.54f / 3.16f, 1e-6f);
  // 0.18: (0.081324 + 0.0054) / (0.078732 + 0.1062 + 0.14)
  EXPECT_NEAR(filmic_curve(0.18f), 0.086724f / 0.324932f, 1e-6f);
}

// The fit's white: 0.08 x^2 - 0.56 x - 0.14 = 0.
TEST(FilmicCurve, RisesToOneAndStays) {
  EXPECT_LT(filmic_curve(7.2f), 1);
  EXPECT_EQ(filmic_curve(7.25f), 1);
  float last = 0;
  for (float x = 0.001f; x < 7; x *= 1.01f) {
    EXPECT_GT(filmic_curve(x), last);
    last = filmic_curve(x);
  }
  for (const float x : {8.0f, 1e4f, 1e30f, kInfinity}) EXPECT_EQ(filmic_curve(x), 1);
}

TEST(FilmicCurve, TakesWhatIsNoRadiance) {
  for (const float x : {-0.0f, -1.0f, -kInfinity, kNan}) EXPECT_EQ(filmic_curve(x), 0);
}

TEST(ToneMapper, CurveSrgbEncodesAndClamps) {
  const ToneMapper map(ToneMapping{});
  EXPECT_FLOAT_EQ(map(0.5f), srgb_from_linear(0.5f));
  EXPECT_EQ(map(1), 1);
  EXPECT_EQ(map(3), 1);
}

TEST(ToneMapper, ExposureCountsInStops) {
  const ToneMapper brighter({ToneMapping::Curve::srgb, 2}), darker({ToneMapping::Curve::srgb, -3});
  EXPECT_FLOAT_EQ(brighter(0.125f), srgb_from_linear(0.5f));
  EXPECT_FLOAT_EQ(darker(4), srgb_from_linear(0.5f));
}

TEST(ToneMapper, CurveFilmicIsEncodedToo) {
  const ToneMapper map({ToneMapping::Curve::filmic, 1});
  EXPECT_FLOAT_EQ(map(0.5f), srgb_from_linear(2.54f / 3.16f));
}

TEST(ToneMapper, NeverLeavesTheUnitIntervalNorMakesNan) {
  for (const auto curve : {ToneMapping::Curve::srgb, ToneMapping::Curve::filmic}) {
    for (const float exposure : {0.0f, 200.0f, -200.0f, kInfinity, -kInfinity}) {
      const ToneMapper map({curve, exposure});
      for (const float dark : {0.0f, -0.0f, -1.0f, -kInfinity, kNan}) EXPECT_EQ(map(dark), 0) << exposure;
      for (const float bright : {1e-45f, 1.0f, 3e38f, kInfinity}) {
        EXPECT_GE(map(bright), 0) << bright << " at " << exposure;
        EXPECT_LE(map(bright), 1) << bright << " at " << exposure;
      }
      if (exposure >= 0) {
        EXPECT_EQ(map(kInfinity), 1) << exposure;
      }
    }
  }
}

TEST(ByteFromUnit, RoundsToNearestAndClamps) {
  EXPECT_EQ(byte_from_unit(0), 0);
  EXPECT_EQ(byte_from_unit(1), 255);
  EXPECT_EQ(byte_from_unit(0.49f / 255), 0);
  EXPECT_EQ(byte_from_unit(0.51f / 255), 1);
  EXPECT_EQ(byte_from_unit(254.49f / 255), 254);
  EXPECT_EQ(byte_from_unit(-0.1f), 0);
  EXPECT_EQ(byte_from_unit(1.1f), 255);
}

}  // namespace
}  // namespace norrsken
