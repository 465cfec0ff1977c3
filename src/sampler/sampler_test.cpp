// What sampling relies on: the Sobol' points are nets, the independent ones are independent, and both are what they
// are whatever the register width (src/isa/parity_test.cpp has that).
#include "sampler/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace norrsken::isa_host {
namespace {

constexpr std::uint64_t kSeed = 20;

Vec2f sample(SamplerKind kind, std::uint32_t pixel, std::uint32_t s, std::uint32_t dimension) {
  return Sampler{kind}.sample_2d(make_sample_key(kind, kSeed, UInt(pixel), s), dimension);
}

/// Every elementary interval of area 1/n, of every shape, holds exactly one of a replicate's first n points: a
/// (0, m, 2)-net (Niederreiter 1992).
TEST(Sobol, EveryReplicateIsANet) {
  for (const std::uint32_t dimension : {0u, 9u, 12u, 801u}) {
    for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate) {
      for (const int m : {1, 2, 4, 6, 8}) {
        const int n = 1 << m;
        for (int rows_log = 0; rows_log <= m; ++rows_log) {
          const int columns = 1 << (m - rows_log), rows = 1 << rows_log;
          std::set<int> cells;
          for (int i = 0; i < n; ++i) {
            const Vec2f u =
                sample(SamplerKind::sobol, 5, static_cast<std::uint32_t>(i) * kReplicates + replicate, dimension);
            cells.insert(static_cast<int>(u.x.v * static_cast<float>(columns)) * rows +
                         static_cast<int>(u.y.v * static_cast<float>(rows)));
          }
          EXPECT_EQ(cells.size(), static_cast<std::size_t>(n)) << columns << " x " << rows;
        }
      }
    }
  }
}

/// Light samples of one hit continue the sequence: n repetitions of m samples are one net of n m points.
TEST(Sobol, RepetitionsRefineTheNet) {
  constexpr std::uint32_t kRepetitions = 8, kPoints = 8;
  std::set<int> cells;
  const Sampler sampler{SamplerKind::sobol};
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const SampleKey key = make_sample_key(SamplerKind::sobol, kSeed, UInt(9u), i * kReplicates);
    for (std::uint32_t k = 0; k < kRepetitions; ++k) {
      const Vec2f u = sampler.sample_2d(sampler.repetition(key, k, kRepetitions), 9);
      cells.insert(static_cast<int>(u.x.v * 8) * 8 + static_cast<int>(u.y.v * 8));
    }
  }
  EXPECT_EQ(cells.size(), 64u);
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0, mb = 0, saa = 0, sbb = 0, sab = 0;
  const double n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
  for (std::size_t i = 0; i < a.size(); ++i) {
    saa += (a[i] - ma) * (a[i] - ma), sbb += (b[i] - mb) * (b[i] - mb), sab += (a[i] - ma) * (b[i] - mb);
  }
  return sab / std::sqrt(saa * sbb);
}

class EverySampler : public testing::TestWithParam<SamplerKind> {};

TEST_P(EverySampler, UniformByChiSquare) {
  constexpr int kCells = 32, kSamples = 1'000'000;
  for (const std::uint32_t dimension : {0u, 13u, 100u}) {
    std::vector<double> counts(kCells * kCells);
    for (int i = 0; i < kSamples; ++i) {
      // One sample of each of a million pixels: those are independent for both kinds.
      const Vec2f u = sample(GetParam(), static_cast<std::uint32_t>(i), 3, dimension);
      for (const float v : {u.x.v, u.y.v}) {
        ASSERT_GE(v, 0.0f);
        ASSERT_LT(v, 1.0f);
      }
      ++counts[static_cast<std::size_t>(u.x.v * kCells) * kCells + static_cast<std::size_t>(u.y.v * kCells)];
    }
    const double expected = static_cast<double>(kSamples) / (kCells * kCells), cells = kCells * kCells;
    double chi2 = 0;
    for (const double c : counts) chi2 += (c - expected) * (c - expected) / expected;
    // Wilson and Hilferty's normal approximation; 4 sigma on fixed seeds.
    const double z = (std::cbrt(chi2 / (cells - 1)) - (1 - 2 / (9 * (cells - 1)))) / std::sqrt(2 / (9 * (cells - 1)));
    EXPECT_LT(std::abs(z), 4.0) << "dimension " << dimension << ", chi2 " << chi2;
  }
}

/// Neighbouring dimensions, samples, pixels and seeds have nothing to do with each other.
TEST_P(EverySampler, Uncorrelated) {
  constexpr std::uint32_t kSamples = 200'000;
  std::vector<double> x, y, other_dimension, other_pixel, other_replicate;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Vec2f u = sample(GetParam(), i, 0, 9);
    x.push_back(static_cast<double>(u.x.v)), y.push_back(static_cast<double>(u.y.v));
    other_dimension.push_back(static_cast<double>(sample(GetParam(), i, 0, 12).x.v));
    other_pixel.push_back(static_cast<double>(sample(GetParam(), i + 1, 0, 9).x.v));
    other_replicate.push_back(static_cast<double>(sample(GetParam(), i, 1, 9).x.v));
  }
  const double limit = 4.0 / std::sqrt(static_cast<double>(kSamples));
  EXPECT_LT(std::abs(correlation(x, y)), limit);
  EXPECT_LT(std::abs(correlation(x, other_dimension)), limit);
  EXPECT_LT(std::abs(correlation(x, other_pixel)), limit);
  EXPECT_LT(std::abs(correlation(x, other_replicate)), limit);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EverySampler, testing::Values(SamplerKind::independent, SamplerKind::sobol),
                         [](const auto& p) { return p.param == SamplerKind::sobol ? "sobol" : "independent"; });

}  // namespace
}  // namespace norrsken::isa_host
