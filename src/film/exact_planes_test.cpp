#include "film/exact_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "film/sample_set.h"

namespace norrsken {
namespace {

/// Positive floats over nine orders of magnitude, and some negative ones, as filters with negative lobes give.
std::vector<double> made_up_samples(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> exponent(-9, 0), unit(0, 1);
  std::vector<double> samples(4096);
  for (double& sample : samples) {
    const float magnitude = std::pow(10.0f, exponent(random));
    sample = static_cast<double>(unit(random) < 0.1f ? -magnitude : magnitude);
  }
  return samples;
}

double sum_in_parts(const std::vector<double>& samples, std::size_t part_size) {
  ExactPlanes total(1);
  for (std::size_t first = 0; first < samples.size(); first += part_size) {
    ExactPlanes part(1);
    for (std::size_t i = first; i < std::min(first + part_size, samples.size()); ++i) part.add(0, samples[i]);
    total.add(part);
  }
  return total[0];
}

TEST(ExactPlanes, SumsDependNeitherOnTheOrderNorOnTheParts) {
  std::mt19937 random(1);
  int plain_sums_that_differ = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::vector<double> samples = made_up_samples(seed);
    const double sum = sum_in_parts(samples, samples.size());
    double plain = 0, plain_shuffled = 0;
    for (const double sample : samples) plain += sample;
    std::ranges::shuffle(samples, random);
    for (const double sample : samples) plain_shuffled += sample;
    plain_sums_that_differ += plain != plain_shuffled;
    for (const std::size_t part_size : {1u, 7u, 64u, 1000u, 4096u}) {
      EXPECT_EQ(sum_in_parts(samples, part_size), sum) << part_size << " at a time";
    }
  }
  EXPECT_GT(plain_sums_that_differ, 10) << "the samples are such that order matters to one double";
}

TEST(ExactPlanes, SumsAreTheNearestDouble) {
  // 1 + 2^-60, whose second part one double loses, summed 2^10 times and taken away again.
  ExactPlanes sum(1);
  for (int i = 0; i < 1024; ++i) {
    sum.add(0, 1.0);
    sum.add(0, 0x1p-60);
  }
  sum.add(0, -1024.0);
  EXPECT_EQ(sum[0], 0x1p-50);
}

TEST(ExactSum, RoundsTo24BitsAsFloatsDo) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10.0, exponent(random));
    EXPECT_EQ(rounded_to_24_bits(value), static_cast<double>(static_cast<float>(value)));
  }
  EXPECT_EQ(rounded_to_24_bits(0x1.8p500), 0x1.8p500) << "beyond a float's range";
  EXPECT_EQ(rounded_to_24_bits(0.0), 0.0);
}

TEST(SampleSet, CountsTheSamplesOfAReplicate) {
  const auto counts = [](const SampleSet& set, std::uint32_t n, std::uint64_t pixel = 0) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t r = 0; r < kReplicates; ++r) result.push_back(set.count_of_replicate(pixel, n, r));
    return result;
  };
  using Counts = std::vector<std::uint32_t>;
  EXPECT_EQ(counts(SampleSet(), 11), (Counts{6, 5}));
  EXPECT_EQ(counts(SampleSet({{3, 100}}), 6), (Counts{3, 3})) << "samples 3 to 8";
  EXPECT_EQ(counts(SampleSet({{0, 2}, {6, 7}, {9, 20}}), 4), (Counts{2, 2})) << "samples 0, 1, 6, 9";
  // Tiles of 2 x 2 in an image of 5 x 4: pixel 13, at (3, 2), is in the second tile of the second row.
  const SampleSet unfinished({{0, 8}, {9, 20}}, {2, 2, 3, 5, {{8, 8, 8, 8, 3, 8}, {0, 0, 0, 0, 2, 0}}});
  EXPECT_EQ(counts(unfinished, 4, 13), (Counts{2, 2})) << "samples 0, 1, 2, 9";
  EXPECT_EQ(counts(unfinished, 8, 0), (Counts{4, 4}));
}

}  // namespace
}  // namespace norrsken
