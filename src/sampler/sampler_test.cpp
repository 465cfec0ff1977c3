// What sampling relies on: the Sobol' points are nets, and the numbers of every plugin of lists/sampler.def are uniform and
// independent of each other. (That they do not depend on the register's width is in src/isa/parity_test.cpp.)
#include "sampler/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "compile/compile_testing.h"
#include "tests/statistics/statistical_test.h"

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

// --- every plugin --------------------------------------------------------------------------------------------------

struct Plugin {
  const char* name;
};
void PrintTo(const Plugin& p, std::ostream* out) { *out << p.name; }
constexpr Plugin kPlugins[] = {
#define NORRSKEN_SAMPLER(name) {#name},
#include "lists/sampler.def"
#undef NORRSKEN_SAMPLER
};

class EverySampler : public ::testing::TestWithParam<Plugin> {
 protected:
  void SetUp() override {
    const auto compiled =
        norrsken::testing::compile_sampler("<sampler type=\"" + std::string(GetParam().name) + "\"/>");
    ASSERT_EQ(compiled.messages(), std::vector<std::string>());
    kind_ = compiled.tables().sampler.kind;
  }
  std::string caption(const std::string& what) const { return std::string(GetParam().name) + ", " + what; }

  SamplerKind kind_{};
};
INSTANTIATE_TEST_SUITE_P(Plugins, EverySampler, ::testing::ValuesIn(kPlugins),
                         [](const auto& p) { return p.param.name; });

constexpr std::uint32_t kPixels = 1'000'000;
constexpr statistics::Rectangle kUnitSquare{{0, 0}, {1, 1}};

/// One sample of each of a million pixels: those are independent for all kinds.
TEST_P(EverySampler, IsUniform) {
  statistics::StatisticalTest test;
  for (const std::uint32_t dimension : {0u, 13u, 100u, 801u}) {
    statistics::EvenCells square(kUnitSquare, 32, 32), line(kUnitSquare, 1024, 1);
    for (std::uint32_t i = 0; i < kPixels; ++i) {
      const Vec2f u = sample(kind_, i, 3, dimension);
      const float v = Sampler{kind_}.sample_1d(make_sample_key(kind_, kSeed, UInt(i), 3), dimension).v;
      for (const float x : {u.x.v, u.y.v, v}) {
        ASSERT_GE(x, 0.0f);
        ASSERT_LT(x, 1.0f);
      }
      square.add({double{u.x.v}, double{u.y.v}});
      line.add({double{v}, 0.5});
    }
    const std::string where = caption("dimension " + std::to_string(dimension));
    EXPECT_TRUE(test.chi_square(square.cells(), {"first number", "second number"}, where));
    EXPECT_TRUE(test.chi_square(line.cells(), {"number", ""}, where));
  }
}

/// Neighbouring dimensions, samples, pixels, replicates and seeds have nothing to do with each other.
TEST_P(EverySampler, NumbersAreIndependent) {
  statistics::StatisticalTest test;
  const auto number = [&](std::uint32_t pixel, std::uint32_t s, std::uint32_t dimension) {
    return double{sample(kind_, pixel, s, dimension).x.v};
  };
  const auto one = [&](std::uint32_t pixel, std::uint32_t dimension) {
    return double{Sampler{kind_}.sample_1d(make_sample_key(kind_, kSeed, UInt(pixel), 0), dimension).v};
  };
  const auto of_seed = [&](std::uint64_t seed, std::uint32_t pixel) {
    return double{Sampler{kind_}.sample_2d(make_sample_key(kind_, seed, UInt(pixel), 0), 9).x.v};
  };
  using Number = std::function<double(std::uint32_t pixel)>;
  const Number first = [&](std::uint32_t i) { return number(i, 0, 9); };
  const struct {
    const char* what;
    Number other;
  } pairs[] = {
      {"the second number of a pair and the next pair's first", [&](std::uint32_t i) { return number(i, 0, 11); }},
      {"another dimension", [&](std::uint32_t i) { return number(i, 0, 42); }},
      {"a number for itself, one before", [&](std::uint32_t i) { return one(i, 8); }},
      {"the pixel to the right", [&](std::uint32_t i) { return number(i + 1, 0, 9); }},
      {"the pixel below", [&](std::uint32_t i) { return number(i + 1024, 0, 9); }},
      {"another replicate", [&](std::uint32_t i) { return number(i, 1, 9); }},
      {"another seed", [&](std::uint32_t i) { return of_seed(kSeed + 1, i); }},
      {"the replicate's next sample", [&](std::uint32_t i) { return number(i, kReplicates, 9); }},
  };
  for (const auto& [what, other] : pairs) {
    // Points of one net are meant to avoid each other.
    const bool is_last = &other == &pairs[std::size(pairs) - 1].other;
    if (is_last && kind_ == SamplerKind::sobol) {
      test.skip(1);
      continue;
    }
    statistics::EvenCells cells(kUnitSquare, 32, 32);
    for (std::uint32_t i = 0; i < kPixels; ++i) cells.add({first(i), other(i)});
    EXPECT_TRUE(test.chi_square(cells.cells(), {"number", "the other"}, caption(what)));
  }
}

/// Of all samples of one pixel.
TEST_P(EverySampler, APixelIsCoveredUniformly) {
  statistics::StatisticalTest test;
  statistics::EvenCells cells(kUnitSquare, 32, 32);
  for (std::uint32_t i = 0; i < kPixels; ++i) {
    const Vec2f u = sample(kind_, 77, i, 9);
    cells.add({double{u.x.v}, double{u.y.v}});
  }
  EXPECT_TRUE(test.chi_square(cells.cells(), {"first number", "second number"}, caption("one pixel")));
}

}  // namespace
}  // namespace norrsken::isa_host
