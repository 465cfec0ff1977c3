// The film's estimates against closed forms.
#include "film/film.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "film/interval.h"
#include "tables/wave_types.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken {
namespace {

FilmSettings size(int width, int height) {
  FilmSettings s;
  s.width = width, s.height = height;
  return s;
}

/// Adds one grey sample to a pixel as the accumulation stage does.
void add(Film& film, SamplerKind kind, std::size_t pixel, double value) {
  const FilmView v = film.view();
  const std::uint32_t sample = v.counts[pixel]++;
  for (std::uint32_t c = 0; c < 3; ++c) {
    if (kind == SamplerKind::independent) {
      v.sum_plane(c)[pixel] += value;
      v.sum_plane(3 + c)[pixel] += value * value;
    } else {
      v.sum_plane(3 * (sample % kReplicates) + c)[pixel] += value;
    }
  }
}

TEST(Film, MeanAndVarianceOfTheMeanOfIndependentSamples) {
  Film film(size(2, 1), SamplerKind::independent);
  for (const double x : {1.0, 2.0, 3.0, 6.0}) add(film, SamplerKind::independent, 1, x);
  const PixelEstimate e = film.estimate(1, 0);
  EXPECT_DOUBLE_EQ(e.mean, 3.0);
  // sum of squared deviations 14, over n - 1 = 3, over n = 4
  EXPECT_NEAR(e.variance, 14.0 / 12.0, 1e-12);
  EXPECT_TRUE(e.known);
}

TEST(Film, VarianceFromReplicates) {
  Film film(size(1, 1), SamplerKind::sobol);
  // Replicates with means 1 and 5 of four samples each: the mean's variance is that of two independent estimates.
  for (const double x : {1.0, 3.0, 0.0, 6.0, 1.0, 3.0, 2.0, 8.0}) add(film, SamplerKind::sobol, 0, x);
  const PixelEstimate e = film.estimate(0, 2);
  EXPECT_DOUBLE_EQ(e.mean, 3.0);
  EXPECT_NEAR(e.variance, 4.0, 1e-12);
}

TEST(Film, UnknownWithFewerThanTwoEstimates) {
  for (const SamplerKind kind : {SamplerKind::independent, SamplerKind::sobol}) {
    Film film(size(1, 1), kind);
    EXPECT_FALSE(film.estimate(0, 0).known);
    add(film, kind, 0, 5.0);
    EXPECT_DOUBLE_EQ(film.estimate(0, 0).mean, 5.0);
    EXPECT_FALSE(film.estimate(0, 0).known);
    EXPECT_EQ(film.error({0, 0, 1, 1}).relative().value, -1);
    const Image image = film.image(true, 0);
    EXPECT_TRUE(std::isnan(image.find("variance.R")->values[0]));
    add(film, kind, 0, 7.0);
    EXPECT_TRUE(film.estimate(0, 0).known);
    EXPECT_NEAR(film.estimate(0, 0).variance, 1.0, 1e-12);
  }
}

/// Over many pixels of known distribution the estimated variance of the mean is the true one, for every count of
/// samples, also where replicates hold different numbers of them.
TEST(Film, VarianceIsUnbiased) {
  statistics::StatisticalTest test;
  constexpr int kPixels = 20'000;
  for (const SamplerKind kind : {SamplerKind::independent, SamplerKind::sobol}) {
    for (const int samples : {2, 3, 4, 8, 16}) {
      Film film(size(kPixels, 1), kind);
      std::mt19937 random(static_cast<unsigned>(samples));
      std::exponential_distribution<double> value(1.0);  // variance 1
      for (int i = 0; i < kPixels; ++i) {
        for (int s = 0; s < samples; ++s) add(film, kind, static_cast<std::size_t>(i), value(random));
      }
      statistics::Mean variance, mean;
      for (int i = 0; i < kPixels; ++i) {
        const PixelEstimate e = film.estimate(static_cast<std::size_t>(i), 0);
        variance.add(e.variance), mean.add(e.mean);
      }
      EXPECT_TRUE(test.agree(variance.estimate(), 1.0 / samples, std::to_string(samples) + " samples, variance"));
      EXPECT_TRUE(test.agree(mean.estimate(), 1, std::to_string(samples) + " samples, mean"));
      const FilmError error = film.error({0, 0, kPixels, 1});
      EXPECT_NEAR(error.variance_sum / (3.0 * kPixels), variance.estimate().mean, 1e-9);
      EXPECT_NEAR(error.mean_sum / (3.0 * kPixels), mean.estimate().mean, 1e-9);
    }
  }
}

TEST(Film, RelativeErrorOfTheImage) {
  Film film(size(2, 1), SamplerKind::independent);
  for (const double x : {1.0, 3.0}) add(film, SamplerKind::independent, 0, x);  // mean 2, variance of the mean 1
  for (const double x : {4.0, 4.0}) add(film, SamplerKind::independent, 1, x);  // mean 4, variance 0
  EXPECT_NEAR(film.error({0, 0, 2, 1}).relative().value, std::sqrt(0.5) / 3.0, 1e-12);
  FilmError sum = film.error({0, 0, 1, 1});
  sum += film.error({1, 0, 1, 1});
  EXPECT_DOUBLE_EQ(sum.relative().value, film.error({0, 0, 2, 1}).relative().value);
  EXPECT_DOUBLE_EQ(sum.relative().high, film.error({0, 0, 2, 1}).relative().high);
  EXPECT_EQ(FilmError{}.relative().value, -1);
}

/// Images of 200 pixels with normal samples, `noisy` of which have all the noise: in how many of them the interval holds
/// the root of the mean squared error.
double share_of_images_held(SamplerKind sampler, std::uint32_t noisy, int samples) {
  constexpr int kImages = 1000, kPixels = 200;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, 1);
  int held = 0;
  for (int image = 0; image < kImages; ++image) {
    Film film(size(kPixels, 1), sampler);
    double squares = 0;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
      for (int i = 0; i < samples; ++i) add(film, sampler, pixel, pixel < noisy ? 40 + normal(random) : 40);
      squares += std::pow(film.estimate(pixel, 0).mean - 40, 2);
    }
    const RelativeError error = film.error({0, 0, kPixels, 1}).relative();
    const double truth = std::sqrt(squares / kPixels) / 40;
    if (error.low <= truth && truth <= error.high) ++held;
  }
  return held / static_cast<double>(kImages);
}

/// 95 % but for chance; also with two samples, and where one pixel has all the noise and its true error is one draw.
TEST(Film, IntervalOfTheRelativeErrorHoldsTheTrueOne) {
  for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
    for (const int samples : {2, 16}) {
      for (const std::uint32_t noisy : {200u, 20u, 5u, 1u}) {
        EXPECT_GE(share_of_images_held(sampler, noisy, samples), 0.93)
            << noisy << " noisy pixels, " << samples << " samples, sampler " << static_cast<int>(sampler);
      }
    }
  }
}

/// Exact values of the F distribution, whose root it is.
TEST(Interval, UncertaintyIsTheRootOfF) {
  for (const auto& [n, f] : {std::pair{1.0, 647.789}, {2.0, 39.0}, {5.0, 7.1464}, {10.0, 3.7168}, {60.0, 1.6668}}) {
    EXPECT_NEAR(error_uncertainty(n), std::sqrt(f), 0.015 * std::sqrt(f)) << n;
  }
}

/// A film in the middle of its second pass says nothing, rather than speak for the pixels that have two samples.
TEST(Film, ErrorIsUnknownUntilThatOfEveryPixelIsKnown) {
  for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
    Film film(size(3, 1), sampler);
    for (const std::size_t pixel : {0u, 1u}) {
      for (const double x : {1.0, 3.0}) add(film, sampler, pixel, x);
    }
    EXPECT_EQ(film.error({0, 0, 3, 1}).relative().value, -1) << "a hole";
    add(film, sampler, 2, 100);
    EXPECT_EQ(film.error({0, 0, 3, 1}).relative().value, -1) << "one sample";
    add(film, sampler, 2, 104);
    // Variances of the means: 1, 1, 4; means 2, 2, 102.
    EXPECT_NEAR(film.error({0, 0, 3, 1}).relative().value, std::sqrt(2.0) / (106 / 3.0), 1e-12);
  }
}

/// Samples that were dropped do not come back: their pixel counts as noisy as the others, and if it is black for want of
/// any, its error is what the others show.
TEST(Film, ErrorOfPixelsThatLostSamples) {
  Film film(size(3, 1), SamplerKind::sobol);
  for (const double x : {2.0, 4.0, 2.0, 4.0}) add(film, SamplerKind::sobol, 0, x);  // mean 3, variance of a sample 4
  for (const double x : {3.0, 3.0}) add(film, SamplerKind::sobol, 1, x);
  film.view().counts[1] |= kSomeDropped;
  film.view().counts[2] = kSomeDropped;
  EXPECT_NEAR(film.error({0, 0, 3, 1}).relative().value, std::sqrt((1.0 + 4.0 / 2 + 9) / 3) / 2, 1e-12);
}

/// Replicates that hold different numbers of samples, as those of paths from the lights do in the middle of a pass.
TEST(Film, VarianceOfUnevenReplicatesIsUnbiased) {
  std::mt19937 random(3);
  std::exponential_distribution<double> value(1);  // variance 1
  constexpr double kCounts[][4] = {{40, 3, 0, 0}, {2, 1, 1, 1}};
  for (const auto& counts : kCounts) {
    double sum = 0, total = 0;
    for (const double n : counts) total += n;
    constexpr int kDraws = 40'000;
    for (int i = 0; i < kDraws; ++i) {
      double sums[4] = {};
      for (std::size_t r = 0; r < 4; ++r) {
        for (double n = 0; n < counts[r]; ++n) sums[r] += value(random);
      }
      sum += estimate_from_replicates(sums, counts).variance;
    }
    EXPECT_NEAR(sum / kDraws * total, 1, 0.04) << counts[0];
  }
}

TEST(Film, LayersOnRequest) {
  Film film(size(1, 1), SamplerKind::independent, {.features = standard_features(), .image_copies = {}, .moments = {}});
  for (const double x : {1.0, 3.0}) add(film, SamplerKind::independent, 0, x);
  EXPECT_EQ(film.image(false, 0).channels.size(), 3u);
  EXPECT_EQ(film.view().feature_mask, 0xffu);
  film.view().features.high[0] = 12.0;  // the sum of four depths
  film.view().features.high[7] = 5.0;
  const Image image = film.image(true, 4);
  EXPECT_EQ(image.find("samples")->values[0], 2.0f);
  EXPECT_NEAR(image.find("variance.G")->values[0], 1.0f, 1e-6f);
  EXPECT_NEAR(image.find("error.G")->values[0], 1.0f, 1e-6f);
  EXPECT_EQ(image.find("depth.Z")->values[0], 3.0f);
  EXPECT_EQ(image.find("id")->values[0], 5.0f);
}

}  // namespace
}  // namespace norrsken
