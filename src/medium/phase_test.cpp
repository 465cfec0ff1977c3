// Every phase function: directions against their density, its integral, and that + is forward.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "medium/models.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

using statistics::Direction;
using statistics::Random;
using statistics::StatisticalTest;

const Mask kOn = first_lanes(1);

/// A scene with one phase function of each kind, and what it looks up.
struct PhaseScene {
  std::vector<float> parameters, texels;
  VolumeRecord volume{};
  SceneView view;

  template <class Stored>
  explicit PhaseScene(const Stored& stored) {
    const auto block = floats_of(stored);
    parameters.assign(block.begin(), block.end());
    // Two voxels of flakes' matrices, then a table of three densities over the cosine and their integrals.
    texels = {0.9f, 0.2f, 0.4f, 0.1f, -0.05f, 0.02f, 0.1f, 0.3f, 0.2f, 0, 0, 0.1f, 0.2f, 0.4f, 1.0f, 0, 0.3f, 1.0f};
    volume.size_x = 2, volume.size_y = volume.size_z = 1;
    volume.channels = 6;
    for (int k = 0; k < 3; ++k) volume.local_from_world[5 * k] = 1;
    view.parameters = parameters.data(), view.texels = texels.data(), view.volumes = &volume;
  }
};

Vec3f lanes(const Direction& d) {
  return {Float(static_cast<float>(d[0])), Float(static_cast<float>(d[1])), Float(static_cast<float>(d[2]))};
}

const Direction kViews[] = {{0.6, 0.0, 0.8}, {0.0, 0.8, -0.6}};

template <class Phase>
void follows_density(StatisticalTest& test, const typename Phase::Stored& stored, const std::string& name) {
  const PhaseScene scene(stored);
  const Vec3f place{0.3f, 0.5f, 0.5f};
  const auto phase = Phase::load(PhaseReader{scene.view, UInt(0u), place, kOn});
  for (const Direction& view : kViews) {
    const Vec3f wo = lanes(view);
    const auto sampling = statistics::sampling_of_directions(
        [&](Random& random) -> std::optional<Direction> {
          const float x = random(), y = random();
          const PhaseSample s = Phase::sample(phase, wo, {Float(x), Float(y)});
          return Direction{double{s.wi.x.v}, double{s.wi.y.v}, double{s.wi.z.v}};
        },
        [&](const Direction& d) { return double{Phase::pdf_sa(phase, wo, lanes(d)).v}; });
    EXPECT_TRUE(test.follows_density(sampling, name));
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
      const float x = random(), y = random();
      const PhaseSample s = Phase::sample(phase, wo, {Float(x), Float(y)});
      EXPECT_NEAR(s.pdf_sa.v, Phase::pdf_sa(phase, wo, s.wi).v, 2e-3f * s.pdf_sa.v + 1e-6f) << name;
    }
  }
}

TEST(Phase, IsotropicFollowsItsDensity) {
  StatisticalTest test;
  follows_density<Isotropic>(test, {}, "isotropic");
}
TEST(Phase, HenyeyGreensteinFollowsItsDensity) {
  StatisticalTest test;
  for (const float g : {0.0f, 0.5f, -0.8f})
    follows_density<HenyeyGreenstein>(test, {.g = g}, "hg " + std::to_string(g));
}
TEST(Phase, RayleighFollowsItsDensity) {
  StatisticalTest test;
  follows_density<Rayleigh>(test, {}, "rayleigh");
}
TEST(Phase, SggxFollowsItsDensity) {
  StatisticalTest test;
  follows_density<Sggx>(test, {.volume = 0}, "sggx");
}
TEST(Phase, TabulatedFollowsItsDensity) {
  StatisticalTest test;
  follows_density<TabulatedPhase>(test, {.segments = 2, .first = 12}, "tabphase");
}

/// Values of Mitsuba 3.9.1 for wo (0.6, 0, 0.8) and wi (0, 0.8, -0.6), whose angle of scattering has the cosine 0.48.
TEST(Phase, ValuesAreThoseOfMitsuba) {
  const Vec3f wo = lanes(kViews[0]), wi = lanes(kViews[1]), place{0.1f, 0.5f, 0.5f};
  const auto value = [&]<class Phase>(const typename Phase::Stored& stored, Phase) {
    const PhaseScene scene(stored);
    return Phase::pdf_sa(Phase::load(PhaseReader{scene.view, UInt(0u), place, kOn}), wo, wi).v;
  };
  EXPECT_NEAR(value(HenyeyGreenstein::Stored{.g = 0.5f}, HenyeyGreenstein{}), 0.0883314f, 1e-6f);
  EXPECT_NEAR(value(Rayleigh::Stored{}, Rayleigh{}), 0.0734341f, 1e-6f);
  EXPECT_NEAR(value(Sggx::Stored{.volume = 0}, Sggx{}), 0.0420672f, 1e-6f);
  EXPECT_NEAR(value(TabulatedPhase::Stored{.segments = 2, .first = 12}, TabulatedPhase{}), 0.109499f, 1e-6f);
}

}  // namespace
}  // namespace norrsken::isa_host
