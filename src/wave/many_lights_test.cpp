// Lights chosen by place against lights chosen by power, over whole waves of a scene with hundreds of lights: the same
// mean, and less noise of as many samples.
#include <cstdio>

#include "isa/kernel_testing.h"
#include "tests/statistics/statistical_test.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kSize = 16, kSamples = 64;

/// A hall whose floor 400 small rectangles and 100 points light from nearby, turned anyhow; some of the light is found
/// by rays from the surfaces, for walls stand near the lights.
std::string hall_of_lights(bool surrounded) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::string xml = R"(<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="3"/>)"
                    R"(<boolean name="hide_emitters" value="true"/></integrator>)"
                    R"(<sensor type="perspective"><float name="fov" value="70"/><transform name="to_world">)"
                    R"(<lookat origin="0,-20,12" target="0,0,0" up="0,0,1"/></transform><sampler type="independent"/>)"
                    R"(<film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/>)"
                    R"(<rfilter type="box"/></film></sensor>)"
                    R"(<shape type="rectangle"><transform name="to_world"><scale value="20"/></transform></shape>)"
                    R"(<shape type="sphere"><point name="center" x="0" y="0" z="0"/><float name="radius" value="60"/>)"
                    R"(<boolean name="flip_normals" value="true"/></shape>)";
  if (surrounded) xml += R"(<emitter type="constant"><rgb name="radiance" value="0.01"/></emitter>)";
  const auto number = [](double x) { return std::to_string(x); };
  for (int i = 0; i < 500; ++i) {
    const std::string x = number(18 * unit(random)), y = number(18 * unit(random)), z = number(1.5 + unit(random));
    if (i % 5 == 0) {
      xml += R"(<emitter type="point"><point name="position" x=")" + x + R"(" y=")" + y + R"(" z=")" + z +
             R"("/><rgb name="intensity" value="0.2"/></emitter>)";
      continue;
    }
    xml += R"(<shape type="rectangle"><transform name="to_world"><scale value="0.2"/><rotate x="1" angle=")" +
           number(180 + 60 * unit(random)) + R"("/><translate x=")" + x + R"(" y=")" + y + R"(" z=")" + z +
           R"("/></transform><emitter type="area"><rgb name="radiance" value=")" + number(6 + 5 * unit(random)) +
           R"("/></emitter></shape>)";
  }
  return xml + "</scene>";
}

using statistics::Estimate;

Estimate estimate(const SceneView& scene, const KernelEntry& kernels) {
  WaveArena arena(kSize * kSize * 4);
  WaveMemory& memory = arena.memory();
  std::vector<double> sums(kSize * kSize), squares(kSize * kSize);
  for (std::uint32_t first = 0; first < kSamples; first += 4) {
    const WaveJob job{0, 0, kSize, kSize, first, 4};
    WaveCounts counts;
    kernels.trace_wave(scene, job, memory, counts);
    for (std::uint32_t s = 0; s < 4; ++s) {
      for (std::uint32_t p = 0; p < kSize * kSize; ++p) {
        const double value = double{memory.slots.field(&stored::Slot::radiance, 1)[s * job.pixel_stride() + p]};
        sums[p] += value, squares[p] += value * value;
      }
    }
  }
  Estimate e{0, 0};
  for (std::uint32_t p = 0; p < kSize * kSize; ++p) {
    const double mean = sums[p] / kSamples;
    e.mean += mean / (kSize * kSize);
    e.variance += (squares[p] / kSamples - mean * mean) / (kSamples - 1) / std::pow(kSize, 4);
  }
  return e;
}

class ManyLightsInAHall : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(, ManyLightsInAHall, ::testing::Bool(),
                         [](const auto& set) { return set.param ? "surrounded" : "alone"; });

TEST_P(ManyLightsInAHall, HaveTheSameMeanAndLessNoiseByPlace) {
  const TemporaryFolder folder;
  const auto hall = view_scene(folder.write("hall.xml", hall_of_lights(GetParam())), AccelKind::embree);
  ASSERT_TRUE(hall);
  ASSERT_NE(hall->view.light_nodes, nullptr);
  SceneView by_power = hall->view;
  by_power.light_nodes = nullptr;
  const KernelEntry& kernels = **usable_kernels();
  statistics::StatisticalTest test;
  Estimate sum[2]{};
  constexpr std::uint64_t kSeeds = 48;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (int k = 0; k < 2; ++k) {
      SceneView scene = k == 0 ? hall->view : by_power;
      scene.sampler.seed = 2 * seed + k;
      const Estimate e = estimate(scene, kernels);
      sum[k].mean += e.mean / kSeeds, sum[k].variance += e.variance / (kSeeds * kSeeds);
    }
  }
  const double sigma = std::sqrt(sum[0].variance + sum[1].variance), ratio = sum[1].variance / sum[0].variance;
  RecordProperty("variance_ratio", std::to_string(ratio));
  std::printf("by place %.5g, by power %.5g, sigma %.2g (%.2g %%), variance of power over place %.3g\n", sum[0].mean,
              sum[1].mean, sigma, 100 * sigma / sum[0].mean, ratio);
  for (Estimate& e : sum) e.replicates = int(kSeeds) * kSamples;
  EXPECT_TRUE(test.agree(sum[0], sum[1], "by place and by power"));
  EXPECT_LT(sigma, 0.01 * sum[0].mean);
  EXPECT_GT(ratio, 1.5);
}

}  // namespace
}  // namespace norrsken
