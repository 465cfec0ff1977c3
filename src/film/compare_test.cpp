#include "norrsken/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "color/srgb.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken {
namespace {

using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image uniform_image(int width, int height, float r, float g, float b) {
  Image image;
  image.width = width;
  image.height = height;
  const float values[3] = {r, g, b};
  const char* names[3] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) image.channel(names[c]).values.assign(image.channel(names[c]).values.size(), values[c]);
  return image;
}

void set_variance(Image& image, float variance) {
  for (const char* name : {"variance.R", "variance.G", "variance.B"}) {
    auto& values = image.channel(name).values;
    values.assign(values.size(), variance);
  }
}

/// Normally distributed around `mean`.
Image noisy_image(int width, int height, float mean, float variance, unsigned seed) {
  Image image = uniform_image(width, height, 0, 0, 0);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(mean, std::sqrt(variance));
  for (Channel& channel : image.channels) {
    for (float& value : channel.values) value = normal(random);
  }
  return image;
}

Comparison compared(const Image& a, const Image& b, const CompareOptions& options = {}, Image* difference = nullptr) {
  Comparison result;
  const IoStatus status = compare(a, b, options, result, difference);
  EXPECT_TRUE(status) << status.error;
  return result;
}

TEST(Compare, EqualImages) {
  const Image image = noisy_image(40, 30, 1, 0.25f, 1);
  const Comparison result = compared(image, image);
  EXPECT_EQ(result.mse, 0);
  EXPECT_EQ(result.rel_mse, 0);
  EXPECT_EQ(result.psnr, kInfinity);
  EXPECT_EQ(result.flip, 0);
  EXPECT_EQ(result.mean_a, result.mean_b);
  EXPECT_FALSE(result.z_test);
}

TEST(Compare, ClosedForms) {
  const Image a = uniform_image(8, 6, 0.5f, 0.25f, 1), b = uniform_image(8, 6, 0.25f, 0.25f, 4);
  const Comparison result = compared(a, b);
  EXPECT_DOUBLE_EQ(result.mse, (0.0625 + 0 + 9) / 3);
  EXPECT_NEAR(result.rel_mse, (0.0625 / 0.0725 + 0 + 9 / 16.01) / 3, 1e-14);
  EXPECT_DOUBLE_EQ(result.mean_a, 1.75 / 3);
  EXPECT_DOUBLE_EQ(result.mean_b, 1.5);
  // Tone mapping clamps the 4 to 1: only red differs.
  const double red = srgb_from_linear(0.5) - srgb_from_linear(0.25);
  EXPECT_NEAR(result.psnr, -10 * std::log10(red * red / 3), 1e-5);
}

TEST(Compare, RelativeErrorIsRelativeToTheSecondImage) {
  const Image a = uniform_image(4, 4, 1, 1, 1), b = uniform_image(4, 4, 2, 2, 2);
  EXPECT_NEAR(compared(a, b).rel_mse, 1 / 4.01, 1e-14);
  EXPECT_NEAR(compared(b, a).rel_mse, 1 / 1.01, 1e-14);
}

TEST(Compare, ExposureAppliesToPsnrAndFlipAlone) {
  const Image a = uniform_image(8, 8, 2, 2, 2), b = uniform_image(8, 8, 4, 4, 4);
  const Comparison bright = compared(a, b);
  EXPECT_EQ(bright.psnr, kInfinity);
  EXPECT_EQ(bright.flip, 0);
  CompareOptions options;
  options.tone.exposure = -3;
  const Comparison dark = compared(a, b, options);
  const double difference = srgb_from_linear(0.5) - srgb_from_linear(0.25);
  EXPECT_NEAR(dark.psnr, -20 * std::log10(difference), 1e-5);
  EXPECT_GT(dark.flip, 0.1);
  EXPECT_EQ(dark.mse, bright.mse);
}

TEST(Compare, DifferenceImageMayReplaceAnInput) {
  Image a = uniform_image(5, 4, 0.5f, 0.25f, 1);
  const Image b = uniform_image(5, 4, 0.75f, 0.25f, 0);
  const Comparison result = compared(a, b, {}, &a);
  EXPECT_EQ(a.width, 5);
  EXPECT_EQ(a.height, 4);
  ASSERT_EQ(a.channels.size(), 4u);
  EXPECT_THAT(a.find("R")->values, testing::Each(0.25f));
  EXPECT_THAT(a.find("G")->values, testing::Each(0.0f));
  EXPECT_THAT(a.find("B")->values, testing::Each(1.0f));
  EXPECT_THAT(a.find("flip")->values, testing::Each(testing::FloatNear(static_cast<float>(result.flip), 1e-6f)));
}

TEST(Compare, WhatIsNotFiniteShowsInTheLinearFigures) {
  Image a = uniform_image(4, 4, 1, 1, 1), b = a;
  a.channels[0].values[5] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(compared(a, b).mse, kInfinity);
  EXPECT_EQ(compared(b, a).rel_mse, kInfinity);
  b.channels[0].values[5] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(compared(a, b).mse, 0);
  a.channels[0].values[5] = kNan;
  const Comparison result = compared(a, b);
  EXPECT_TRUE(std::isnan(result.mse));
  EXPECT_TRUE(std::isfinite(result.psnr));  // shown as black
  EXPECT_GT(result.flip, 0);
}

TEST(Compare, SaysWhatDiffers) {
  const Image image = uniform_image(4, 3, 1, 1, 1);
  Comparison result;
  result.mse = 7;
  EXPECT_EQ(compare(image, uniform_image(3, 4, 1, 1, 1), {}, result).error, "the images differ in size: 4x3 and 3x4");
  EXPECT_EQ(compare(Image{}, Image{}, {}, result).error, "the images are empty");
  Image grey;
  grey.width = 4;
  grey.height = 3;
  EXPECT_EQ(compare(image, grey, {}, result).error, "the second image has no channel R; it has none");
  grey.channel("Y");
  grey.channel("A");
  EXPECT_EQ(compare(grey, image, {}, result).error, "the first image has no channel R; it has Y, A");
  Image broken = image;
  broken.channels[1].values.clear();
  EXPECT_EQ(compare(image, broken, {}, result).error, "the second image: channel G does not have 4x3 pixels");
  for (const double pixels : {0.0, -1.0, 1e9, std::nan("")}) {
    EXPECT_THAT(compare(image, image, {.tone = {}, .pixels_per_degree = pixels}, result).error,
                HasSubstr("accepted are 1 to 1000"));
  }
  EXPECT_EQ(result.mse, 7);
}

TEST(CompareZTest, HonestVariancesPass) {
  Image a = noisy_image(200, 150, 1, 0.04f, 1), b = noisy_image(200, 150, 1, 0.09f, 2);
  set_variance(a, 0.04f);
  set_variance(b, 0.09f);
  const auto test = compared(a, b).z_test;
  ASSERT_TRUE(test);
  EXPECT_EQ(test->passed_share, 1);
  statistics::StatisticalTest verdicts;
  // The RMS of n normal deviates is 1 with a variance of 1 / (2 n).
  constexpr int kValues = 3 * 200 * 150;
  EXPECT_TRUE(verdicts.agree({test->rms_z, 0.5 / kValues, kValues}, 1, "RMS of z"));
  for (const double z : test->mean_z) EXPECT_TRUE(verdicts.agree({z, 1, kValues / 3}, 0, "mean of z"));
}

TEST(CompareZTest, ASmallBiasShowsInTheMeans) {
  Image a = noisy_image(200, 150, 1, 0.04f, 1), b = noisy_image(200, 150, 1.02f, 0.04f, 2);
  set_variance(a, 0.04f);
  set_variance(b, 0.04f);
  const auto test = compared(a, b).z_test;
  ASSERT_TRUE(test);
  EXPECT_EQ(test->passed_share, 1);
  statistics::StatisticalTest verdicts;
  for (const double z : test->mean_z)
    EXPECT_TRUE(verdicts.agree({z, 1, 30'000}, -0.02 / std::sqrt(0.08 / 30'000), "mean of z"));
}

TEST(CompareZTest, OneSideWithoutVarianceIsTakenAsExact) {
  Image a = uniform_image(2, 1, 1, 1, 1);
  set_variance(a, 0.25f);
  const auto test = compared(a, uniform_image(2, 1, 2, 1.5f, 1)).z_test;
  ASSERT_TRUE(test);
  // z: -2, -1, 0 in each of two pixels; means: twice the difference over sqrt(2) deviations.
  EXPECT_NEAR(test->rms_z, std::sqrt(5.0 / 3), 1e-12);
  EXPECT_NEAR(test->mean_z[0], -2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(test->mean_z[1], -1 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(test->mean_z[2], 0);
  EXPECT_EQ(test->passed_share, 1);
}

// Three tests at 1 % in all: each at 1 - 0.99^(1/3) = 0.003345, two-sided, which is |z| = 2.93416; Bonferroni's bound
// is 2.9352.
TEST(CompareZTest, RejectsAtTheSidakLevel) {
  for (const auto& [z, share] : {std::pair{2.9339f, 1.0}, std::pair{2.9345f, 2.0 / 3}}) {
    for (const float sign : {1.0f, -1.0f}) {
      Image a = uniform_image(1, 1, sign * z, 0, 0);
      set_variance(a, 1);
      const auto test = compared(a, uniform_image(1, 1, 0, 0, 0)).z_test;
      ASSERT_TRUE(test);
      EXPECT_DOUBLE_EQ(test->passed_share, share) << z;
    }
  }
}

TEST(CompareZTest, WithoutAnyVarianceAPixelIsComparedExactly) {
  Image a = uniform_image(2, 1, 1, 1, 1), b = a;
  set_variance(a, 0.01f);
  for (const char* name : {"variance.R", "variance.G", "variance.B"}) a.channel(name).values[0] = 0;
  const auto equal = compared(a, b).z_test;
  ASSERT_TRUE(equal);
  EXPECT_EQ(equal->passed_share, 1);
  EXPECT_EQ(equal->rms_z, 0);
  b.channel("G").values[0] = std::nextafter(1.0f, 2.0f);
  const auto unequal = compared(a, b).z_test;
  ASSERT_TRUE(unequal);
  EXPECT_DOUBLE_EQ(unequal->passed_share, 5.0 / 6);
  EXPECT_LT(unequal->rms_z, 1e-5);  // the exact comparison has no z-score that could be averaged
}

TEST(CompareZTest, UnknownVariancesAreLeftOut) {
  Image a = uniform_image(2, 1, 1, 1, 1);
  const Image b = uniform_image(2, 1, 2, 2, 2);
  set_variance(a, 0.25f);
  for (const float unknown : {kNan, static_cast<float>(kInfinity), -1.0f}) {
    for (const char* name : {"variance.R", "variance.G", "variance.B"}) a.channel(name).values[0] = unknown;
    const auto test = compared(a, b).z_test;
    ASSERT_TRUE(test);
    EXPECT_DOUBLE_EQ(test->rms_z, 2);
    EXPECT_DOUBLE_EQ(test->mean_z[0], -2);
  }
  set_variance(a, kNan);
  EXPECT_FALSE(compared(a, b).z_test);
}

}  // namespace
}  // namespace norrsken
