#include "color/spectrum.h"

#include <gtest/gtest.h>

#include <vector>

namespace norrsken {
namespace {

using Samples = std::vector<std::pair<double, double>>;

// CIE 1931 tables (CIE 015:2018): peaks of the curves and a value on either side. The fit is good to about 0.02.
TEST(Spectrum, MatchingFunctionsFollowTheCieTables) {
  const struct {
    double wavelength;
    ColorVector xyz;
  } table[] = {{450, {0.3362, 0.0380, 1.77211}},
               {500, {0.0049, 0.3230, 0.2720}},
               {555, {0.5121, 1.0000, 0.0057}},
               {600, {1.0622, 0.6310, 0.0008}},
               {650, {0.2835, 0.1070, 0.0000}}};
  for (const auto& row : table) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(cie_matching(row.wavelength)[k], row.xyz[k], 0.02) << row.wavelength;
  }
}

TEST(Spectrum, FlatReflectanceIsGrey) {
  const Samples constant{{0, 0.25}};
  const Samples spelled_out{{300, 0.25}, {900, 0.25}};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(rgb_of_reflectance(constant)[k], 0.25);
    EXPECT_NEAR(rgb_of_reflectance(spelled_out)[k], 0.25, 1e-12);
  }
}

TEST(Spectrum, ConstantEmissionIsWhite) {
  const Samples constant{{0, 3}};
  EXPECT_EQ(rgb_of_emission(constant), (ColorVector{3, 3, 3}));
}

// Equal energy has chromaticity (1/3, 1/3); with the sRGB matrix that is (1.2048, 0.9484, 0.9087).
TEST(Spectrum, EqualEnergyEmissionIsSlightlyRed) {
  const Samples flat{{300, 2}, {900, 2}};
  const ColorVector rgb = rgb_of_emission(flat);
  EXPECT_NEAR(rgb[0], 2 * 1.2048, 0.03);
  EXPECT_NEAR(rgb[1], 2 * 0.9484, 0.03);
  EXPECT_NEAR(rgb[2], 2 * 0.9087, 0.03);
  EXPECT_NEAR(luminance(rgb[0], rgb[1], rgb[2]), 2.0, 1e-3);
}

TEST(Spectrum, LongWavelengthsAreRedAndShortOnesBlue) {
  const ColorVector red = rgb_of_reflectance(Samples{{600, 0}, {620, 1}, {830, 1}});
  EXPECT_GT(red[0], 0.5);
  EXPECT_LT(red[1], 0.1);
  EXPECT_LT(red[2], 0.1);
  const ColorVector blue = rgb_of_reflectance(Samples{{360, 1}, {480, 1}, {490, 0}});
  EXPECT_GT(blue[2], 0.5);
  EXPECT_LT(blue[0], 0.2);
}

TEST(Spectrum, IsLinearBetweenAndZeroOutside) {
  const ColorVector triangle = rgb_of_emission(Samples{{500, 0}, {550, 1}, {600, 0}});
  const ColorVector twice = rgb_of_emission(Samples{{500, 0}, {525, 1}, {550, 2}, {575, 1}, {600, 0}});
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(2 * triangle[k], twice[k], 1e-12);
  EXPECT_EQ(rgb_of_emission(Samples{{900, 1}, {1000, 1}}), (ColorVector{0, 0, 0}));
}

}  // namespace
}  // namespace norrsken
