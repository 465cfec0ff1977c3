#include "color/srgb.h"

#include <gtest/gtest.h>

namespace norrsken {
namespace {

// IEC 61966-2-1, annex F gives the matrix to four places.
TEST(Srgb, MatrixIsTheStandards) {
  const double expected[3][3] = {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      EXPECT_NEAR(kXyzFromSrgb[row][column], expected[row][column], 5e-5) << row << "," << column;
    }
  }
}

TEST(Srgb, WhiteIsD65) {
  const ColorVector white = kXyzFromSrgb * ColorVector{1, 1, 1};
  const double sum = white[0] + white[1] + white[2];
  EXPECT_NEAR(white[0] / sum, 0.3127, 1e-12);
  EXPECT_NEAR(white[1] / sum, 0.3290, 1e-12);
  EXPECT_NEAR(white[1], 1, 1e-12);
}

TEST(Srgb, MatricesAreInverses) {
  const ColorVector color{0.1, 0.7, 0.3};
  const ColorVector back = kSrgbFromXyz * (kXyzFromSrgb * color);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], color[c], 1e-12);
}

TEST(Srgb, LuminanceWeighsAsBt709) {
  EXPECT_NEAR(luminance(1.0, 0.0, 0.0), 0.2126, 1e-4);
  EXPECT_NEAR(luminance(0.0, 1.0, 0.0), 0.7152, 1e-4);
  EXPECT_NEAR(luminance(0.0, 0.0, 1.0), 0.0722, 1e-4);
  EXPECT_NEAR(luminance(0.5f, 0.5f, 0.5f), 0.5f, 1e-7f);
}

TEST(Srgb, TransferFunctionAtKnownPoints) {
  EXPECT_EQ(srgb_from_linear(0.0), 0.0);
  EXPECT_EQ(srgb_from_linear(1.0), 1.0);
  EXPECT_EQ(srgb_from_linear(1.0f), 1.0f);
  EXPECT_DOUBLE_EQ(srgb_from_linear(0.002), 0.02584);
  // 1.055 * 2^(-1/2.4) - 0.055
  EXPECT_NEAR(srgb_from_linear(0.5), 0.735356983052, 1e-11);
  // ((0.5 + 0.055) / 1.055)^2.4
  EXPECT_NEAR(linear_from_srgb(0.5), 0.214041140483, 1e-11);
  EXPECT_DOUBLE_EQ(linear_from_srgb(0.02584), 0.002);
}

TEST(Srgb, TransferFunctionIsContinuousAtItsJoints) {
  EXPECT_NEAR(srgb_from_linear(0.0031308 - 1e-9), srgb_from_linear(0.0031308 + 1e-9), 1e-6);
  EXPECT_NEAR(linear_from_srgb(0.04045 - 1e-9), linear_from_srgb(0.04045 + 1e-9), 1e-6);
}

TEST(Srgb, EveryByteSurvivesDecodingAndEncoding) {
  for (int byte = 0; byte < 256; ++byte) {
    const float linear = linear_from_srgb(static_cast<float>(byte) / 255.0f);
    EXPECT_EQ(std::lround(srgb_from_linear(linear) * 255.0f), byte);
  }
}

}  // namespace
}  // namespace norrsken
