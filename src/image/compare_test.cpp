#include "norrsken/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

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

Comparison compared(const Image& a, const Image& b, CompareOptions options = {}, Image* difference = nullptr) {
  options.difference = difference != nullptr;
  Result<Comparison> result = compare(a, b, options);
  EXPECT_TRUE(result) << result.error();
  if (difference && result) *difference = result->difference;
  return result ? *result : Comparison();
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
  for (const double figure : {result.mse, result.rel_mse, result.psnr, result.flip, result.mean_a}) {
    EXPECT_TRUE(std::isnan(figure)) << figure;
  }
  EXPECT_EQ(result.nan_a, 1u);
  EXPECT_EQ(result.nan_b, 0u);
  EXPECT_TRUE(std::isnan(compared(b, a).psnr));
  EXPECT_EQ(compared(b, a).nan_b, 1u);
}

/// What EXR files of `pixel_format` xyz and luminance hold.
Image converted(const Image& image, std::vector<std::pair<const char*, ColorVector>> channels) {
  Image result;
  result.width = image.width;
  result.height = image.height;
  for (const auto& [name, weights] : channels) {
    std::vector<float>& values = result.channel(name).values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += weights[c] * static_cast<double>(image.channels[c].values[i]);
      values[i] = static_cast<float>(sum);
    }
  }
  return result;
}

TEST(Compare, XyzAndLuminance) {
  const Image a = noisy_image(20, 10, 1, 0.01f, 1), b = noisy_image(20, 10, 1, 0.01f, 2);
  const auto xyz = [](const Image& image) {
    return converted(image, {{"X", kXyzFromSrgb[0]}, {"Y", kXyzFromSrgb[1]}, {"Z", kXyzFromSrgb[2]}});
  };
  const auto luminance = [](const Image& image) { return converted(image, {{"A", {}}, {"Y", kXyzFromSrgb[1]}}); };
  EXPECT_NEAR(compared(xyz(a), b).mse, compared(a, b).mse, 1e-6);
  EXPECT_NEAR(compared(a, xyz(a)).mse, 0, 1e-12);
  const Comparison grey = compared(luminance(a), luminance(b));
  EXPECT_GT(grey.mse, 0.005);
  // By luminance also if just one has nothing else.
  EXPECT_NEAR(compared(luminance(a), b).mse, grey.mse, 1e-6);
  EXPECT_NEAR(compared(a, luminance(b)).mse, grey.mse, 1e-6);
  EXPECT_NEAR(compared(a, luminance(a)).mse, 0, 1e-12);
}

TEST(Compare, LuminanceHasTheVarianceOfItsColors) {
  Image a = uniform_image(2, 1, 2, 2, 2), b = uniform_image(2, 1, 1, 1, 1);
  set_variance(a, 0.25f);
  const Image grey = converted(b, {{"Y", kXyzFromSrgb[1]}});
  const auto test = compared(a, grey).z_test;
  ASSERT_TRUE(test);
  EXPECT_NEAR(test->rms_z, 2, 1e-6);
}

TEST(Compare, SaysWhatDiffers) {
  const Image image = uniform_image(4, 3, 1, 1, 1);
  EXPECT_EQ(compare(image, uniform_image(3, 4, 1, 1, 1)).error(), "the images differ in size: 4x3 and 3x4");
  EXPECT_EQ(compare(Image{}, Image{}).error(), "the images are empty");
  Image grey;
  grey.width = 4;
  grey.height = 3;
  EXPECT_EQ(compare(image, grey).error(), "the second image has neither R, G, B nor X, Y, Z nor Y; it has none");
  grey.channel("R");
  grey.channel("A");
  EXPECT_EQ(compare(grey, image).error(), "the first image has neither R, G, B nor X, Y, Z nor Y; it has R, A");
  Image broken = image;
  broken.channels[1].values.clear();
  EXPECT_EQ(compare(image, broken).error(), "the second image: channel G does not have 4x3 pixels");
  for (const double pixels : {0.0, -1.0, 1e9, std::nan("")}) {
    EXPECT_THAT(compare(image, image, {.tone = {}, .pixels_per_degree = pixels}).error(),
                HasSubstr("accepted are 1 to 1000"));
  }
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

/// As many people have it: a quick image without layers against a good one with them.
TEST(CompareZTest, WhatHasNoLayersIsNotTakenAsFreeOfNoise) {
  const Image quick = noisy_image(200, 150, 1, 0.04f, 1);
  Image good = noisy_image(200, 150, 1, 0.0004f, 2);
  set_variance(good, 0.0004f);
  using Estimated = Comparison::ZTest::Estimated;
  const auto check = [](const Comparison& result, Estimated estimated) {
    ASSERT_TRUE(result.z_test);
    EXPECT_EQ(result.z_test->estimated, estimated);
    EXPECT_EQ(result.z_test->passed_share, 1);
    EXPECT_NEAR(result.z_test->rms_z, 0.85, 0.1) << "a little less than 1: noise is estimated generously";
    for (const double z : result.z_test->mean_z) EXPECT_LT(std::abs(z), 3);
  };
  check(compared(quick, good), Estimated::a);
  check(compared(good, quick), Estimated::b);
  std::erase_if(good.channels, [](const Channel& channel) { return channel.name == "variance.B"; });
  EXPECT_FALSE(compared(quick, good).z_test) << "a part of the layers is none";
}

/// Noise is estimated, and what is wrong all over is found in spite of it.
TEST(CompareZTest, ABiasShowsBesideEstimatedNoise) {
  Image a = noisy_image(200, 150, 1, 0.04f, 1);
  Image b = noisy_image(200, 150, 1.02f, 0.0004f, 2);
  set_variance(b, 0.0004f);
  const auto test = compared(a, b).z_test;
  ASSERT_TRUE(test);
  for (const double z : test->mean_z) EXPECT_NEAR(z, -0.02 / std::sqrt(0.0404 / 30'000), 3.5);
}

/// A closed form without layers, say.
TEST(CompareZTest, WhatDiffersEvenlyIsNoNoise) {
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
  set_variance(b, 0);
  for (const char* name : {"variance.R", "variance.G", "variance.B"}) a.channel(name).values[0] = 0;
  const auto equal = compared(a, b).z_test;
  ASSERT_TRUE(equal);
  EXPECT_EQ(equal->passed_share, 1);
  EXPECT_EQ(equal->rms_z, 0);
  b.channel("G").values[0] = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(compared(a, b).z_test->passed_share, 1) << "what a conversion of colours rounds is no difference";
  b.channel("G").values[0] = 1.00001f;
  const auto unequal = compared(a, b).z_test;
  ASSERT_TRUE(unequal);
  EXPECT_DOUBLE_EQ(unequal->passed_share, 5.0 / 6);
  EXPECT_LT(unequal->rms_z, 1e-3);  // the exact comparison has no z-score that could be averaged
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
