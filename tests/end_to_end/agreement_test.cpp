// Choices that must not change what the hexagon room looks like: samplers, shadow rays, accelerators, instruction
// sets. And the error layers, which must tell how much images of different seeds do differ.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/reported_variance.h"
#include "tests/end_to_end/room.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

using statistics::Judge;

TEST(Agreement, OneAndFourShadowRays) {
  constexpr RoomResolution kResolution{0.005, 0.01, 0.02, 0.05};
  Judge judge("agreement.shadow_rays");
  for (const char* integrator : {"path", "whitted"}) {
    judge.compare(integrator,
                  room_replicates({.integrator = integrator, .shadow_rays = 4}, 256, 300, kResolution).estimates(),
                  room_replicates({.integrator = integrator, .shadow_rays = 1}, 256, 400, kResolution).estimates());
  }
  EXPECT_TRUE(judge.verdict());
}

TEST(Agreement, IndependentAndSobolSamples) {
  constexpr RoomResolution kResolution{0.005, 0.01, 0.02, 0.05};
  Judge judge("agreement.samplers");
  judge.compare("", room_replicates({.sampler = "independent"}, 512, 500, kResolution).estimates(),
                room_replicates({.sampler = "sobol"}, 256, 600, kResolution).estimates());
  EXPECT_TRUE(judge.verdict());
}

TEST(Agreement, SampleCountsThatAreNoPowerOfTwo) {
  constexpr RoomResolution kResolution{0.01, 0.02, 0.04, 0.1};
  Judge judge("agreement.odd_samples");
  judge.compare("", room_replicates({}, 61, 700, kResolution).estimates(),
                room_replicates({}, 256, 800, kResolution).estimates());
  EXPECT_TRUE(judge.verdict());
}

/// Renderings that take the same random numbers and differ by rounding: few paths come out differently at all.
void expect_same_paths(const std::string& family, const RenderOptions& tested, const RenderOptions& reference) {
  constexpr RoomResolution kResolution{0.005, 0.01, 0.02, 0.05};
  constexpr int kSamples = 16, kFirstSeed = 900;
  Judge judge(family);
  judge.compare_paired("", room_replicates({}, kSamples, kFirstSeed, kResolution, tested),
                       room_replicates({}, kSamples, kFirstSeed, kResolution, reference));
  EXPECT_TRUE(judge.verdict());
}

class Accelerator : public ::testing::TestWithParam<const char*> {};

TEST_P(Accelerator, AgreesWithMollerTrumbore) {
  expect_same_paths("agreement.accelerator." + std::string(GetParam()), {.accelerator = GetParam()},
                    {.accelerator = "moller_trumbore"});
}

INSTANTIATE_TEST_SUITE_P(, Accelerator, ::testing::Values("planes", "bvh", "embree"), kParamName);

class Isa : public ::testing::TestWithParam<const char*> {};

TEST_P(Isa, AgreesWithScalar) {
  const auto usable = usable_isas();
  if (std::ranges::find(usable, GetParam()) == usable.end()) GTEST_SKIP() << "not usable here";
  expect_same_paths("agreement.isa." + std::string(GetParam()), {.isa = GetParam()}, {.isa = "scalar"});
}

INSTANTIATE_TEST_SUITE_P(, Isa, ::testing::Values("sse4.2", "avx2", "avx512", "neon"), kParamName);

class ReportedVariance : public ::testing::TestWithParam<const char*> {};

TEST_P(ReportedVariance, IsThatOfImagesOfDifferentSeeds) {
  statistics::StatisticalTest test;
  EXPECT_TRUE(reports_its_variance(test, 0.06, load_room({.sampler = GetParam()}),
                                   {.samples_per_pixel = 16, .seed = 5000}, 64, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(, ReportedVariance, ::testing::Values("independent", "sobol"), kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
