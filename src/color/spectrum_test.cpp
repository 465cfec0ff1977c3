#include "color/spectrum.h"

#include <gtest/gtest.h>

#include <vector>

namespace norrsken {
namespace {

using Samples = std::vector<std::pair<double, double>>;

// CIE 015:2018: values at 5 nm, and between them.
TEST(Spectrum, MatchingFunctionsFollowTheCieTables) {
  const struct {
    double wavelength;
    ColorVector xyz;
  } table[] = {{450, {0.3362, 0.0380, 1.77211}},
               {500, {0.0049, 0.3230, 0.2720}},
               {555, {0.5121, 1.0000, 0.00575}},
               {600, {1.0622, 0.6310, 0.0008}},
               {652.5, {(0.2835 + 0.2187) / 2, (0.1070 + 0.0816) / 2, 0.0000}},
               {359, {0, 0, 0}},
               {831, {0, 0, 0}}};
  for (const auto& row : table) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(cie_matching(row.wavelength)[k], row.xyz[k], 5e-5) << row.wavelength;
  }
}

TEST(Spectrum, FlatReflectanceIsGrey) {
  const Samples constant{{0, 0.25}};
  const Samples spelled_out{{300, 0.25}, {411, 0.25}, {900, 0.25}};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(rgb_of_reflectance(constant)[k], 0.25);
    EXPECT_NEAR(rgb_of_reflectance(spelled_out)[k], 0.25, 1e-12);
  }
}

// Equal energy has chromaticity (1/3, 1/3); with the sRGB matrix that is (1.2048, 0.9484, 0.9087).
TEST(Spectrum, EqualEnergyEmissionIsSlightlyRed) {
  for (const Samples& flat : {Samples{{300, 2}, {900, 2}}, Samples{{0, 2}}}) {
    const ColorVector rgb = rgb_of_emission(flat);
    EXPECT_NEAR(rgb[0], 2 * 1.2048, 1e-3);
    EXPECT_NEAR(rgb[1], 2 * 0.9484, 1e-3);
    EXPECT_NEAR(rgb[2], 2 * 0.9087, 1e-3);
    EXPECT_NEAR(luminance(rgb[0], rgb[1], rgb[2]), 2.0, 1e-12);
  }
}

// What Mitsuba 3.9 (scalar_rgb) makes of the same spectra; it sums a thousand steps.
TEST(Spectrum, AgreesWithMitsuba) {
  const Samples samples{{400, 0.1}, {500, 0.9}, {600, 0.5}, {700, 0.2}};
  const ColorVector reflectance{0.315818, 0.772604, 0.511516}, emission{0.419126, 0.7336, 0.451901};
  const Samples narrow{{600, 0}, {601, 1}, {620, 1}, {640, 0}};
  const ColorVector narrow_reflectance{0.546921, -0.0120089, -0.00954226};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(rgb_of_reflectance(samples)[k], reflectance[k], 2e-3 * reflectance[k]);
    EXPECT_NEAR(rgb_of_emission(samples)[k], emission[k], 2e-3 * emission[k]);
    EXPECT_NEAR(rgb_of_reflectance(narrow)[k], narrow_reflectance[k], 2e-3);
  }
}

TEST(Spectrum, LongWavelengthsAreRedAndShortOnesBlue) {
  const ColorVector red = rgb_of_reflectance(Samples{{600, 0}, {620, 1}, {830, 1}});
  EXPECT_GT(red[0], 0.4);
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
  EXPECT_EQ(rgb_of_emission(Samples{{200, 1}, {300, 1}}), (ColorVector{0, 0, 0}));
}

// A line as narrow as a laser's keeps its power, wherever it lies between the table's wavelengths.
TEST(Spectrum, NarrowLinesKeepTheirPower) {
  const Samples line{{552.4, 0}, {552.5, 1000}, {552.6, 0}};
  const ColorVector rgb = rgb_of_emission(line);
  EXPECT_NEAR(luminance(rgb[0], rgb[1], rgb[2]), 100 * (0.99495 + 1.0) / 2 / 106.857, 2e-4);
}

// 3000 K and 6500 K: Mitsuba 3.9 in its spectral mode, averaged over a few hundred thousand samples.
TEST(Spectrum, BlackBodies) {
  const auto rgb_of = [](double temperature) {
    Samples samples;
    for (int w = 360; w <= 830; w += 5) samples.emplace_back(w, blackbody_radiance(w, temperature));
    return rgb_of_emission(samples);
  };
  EXPECT_NEAR(blackbody_radiance(500, 3000), 260.268, 0.01);
  const ColorVector warm{733.5, 350.0, 112.8}, day{43942, 41451, 43630};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(rgb_of(3000)[k], warm[k], 5e-3 * warm[k]);
    EXPECT_NEAR(rgb_of(6500)[k], day[k], 5e-3 * day[k]);
  }
}

}  // namespace
}  // namespace norrsken
