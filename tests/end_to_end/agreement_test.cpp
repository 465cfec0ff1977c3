// Choices that must not change what the hexagon room looks like: samplers, shadow rays, accelerators, instruction
// sets. And the error layers, which must tell how much images of different seeds do differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/room.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

using statistics::Judge;
using statistics::Picture;

constexpr int kSamples = 64;

TEST(Agreement, OneAndFourShadowRays) {
  Judge judge("agreement.shadow_rays");
  for (const char* light : {"area", "point"}) {
    judge.compare(light, room_replicates({.light = light, .shadow_rays = 4}, kSamples, 100),
                  room_replicates({.light = light, .shadow_rays = 1}, kSamples, 200));
  }
  EXPECT_TRUE(judge.verdict());
}

TEST(Agreement, IndependentAndSobolSamples) {
  Judge judge("agreement.samplers");
  judge.compare("", room_replicates({.sampler = "independent"}, kSamples, 300),
                room_replicates({.sampler = "sobol"}, kSamples, 400));
  EXPECT_TRUE(judge.verdict());
}

TEST(Agreement, SampleCountsThatAreNoPowerOfTwo) {
  Judge judge("agreement.odd_samples");
  judge.compare("", room_replicates({}, 37, 500), room_replicates({}, kSamples, 600));
  EXPECT_TRUE(judge.verdict());
}

class Accelerator : public ::testing::TestWithParam<const char*> {};

TEST_P(Accelerator, AgreesWithMollerTrumbore) {
  Judge judge("agreement.accelerator." + std::string(GetParam()));
  judge.compare("", room_replicates({}, kSamples, 700, {.accelerator = GetParam()}),
                room_replicates({}, kSamples, 800, {.accelerator = "moller_trumbore"}));
  EXPECT_TRUE(judge.verdict());
}

INSTANTIATE_TEST_SUITE_P(, Accelerator, ::testing::Values("planes", "embree"), kParamName);

class Isa : public ::testing::TestWithParam<const char*> {};

TEST_P(Isa, AgreesWithTheWidestThatThisProcessorHas) {
  const auto usable = usable_isas();
  if (std::ranges::find(usable, GetParam()) == usable.end()) GTEST_SKIP() << "not usable here";
  Judge judge("agreement.isa." + std::string(GetParam()));
  judge.compare("", room_replicates({}, kSamples, 900, {.isa = GetParam()}),
                room_replicates({}, kSamples, 1000, {.isa = usable.front()}));
  EXPECT_TRUE(judge.verdict());
}

INSTANTIATE_TEST_SUITE_P(, Isa, ::testing::Values("scalar", "sse4.2", "avx2", "avx512"), kParamName);

class ReportedVariance : public ::testing::TestWithParam<const char*> {};

TEST_P(ReportedVariance, IsThatOfImagesOfDifferentSeeds) {
  const Scene scene = load_room({.sampler = GetParam()});
  constexpr int kImages = 48;
  const std::size_t pixel_count = static_cast<std::size_t>(kRoomSize) * kRoomSize;
  std::vector<double> sum(pixel_count), squares(pixel_count);
  double reported = 0;
  for (int i = 0; i < kImages; ++i) {
    const Image image = render_image(scene, {.samples_per_pixel = 16, .seed = 5000u + i, .threads = kThreads}, true);
    const Channel *green = image.find("G"), *variance = image.find("variance.G");
    ASSERT_TRUE(green && variance);
    for (std::size_t p = 0; p < pixel_count; ++p) {
      const double value = static_cast<double>(green->values[p]);
      sum[p] += value;
      squares[p] += value * value;
      reported += static_cast<double>(variance->values[p]) / kImages;
    }
  }
  double observed = 0;
  for (std::size_t p = 0; p < pixel_count; ++p) {
    observed += (squares[p] - sum[p] * sum[p] / kImages) / (kImages - 1);
  }
  // Summed over 4096 pixels the two have relative errors near 1 %.
  EXPECT_NEAR(reported / observed, 1, 0.05);
}

INSTANTIATE_TEST_SUITE_P(, ReportedVariance, ::testing::Values("independent", "sobol"), kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
