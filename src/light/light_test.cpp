// What arrives from lights on a plane in closed form, and what is special to some kinds. light_sampling_test.cpp has what
// holds for all.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "light/every_light_testing.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

constexpr double kPi2 = 2 * M_PI;
const glm::dvec3 kReference(0.3, -0.2, 0.1);
const std::string kEnvmap = R"(<emitter type="envmap"><string name="filename" value="env.hdr"/>)";

/// Densities of curved surfaces have no bound at their outline; their inverse has.
TEST(AnalyticAreaLight, SamplesOfACylinderCoverItsSolidAngle) {
  const LitScene scene(
      R"(<shape type="cylinder"><point name="p0" x="1" y="1" z="-1"/><point name="p1" x="1" y="1.5" z="1"/>)"
      R"(<float name="radius" value="0.5"/><emitter type="area"/></shape>)");
  constexpr int kGrid = 500;
  double sampled = 0, seen = 0;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const double u = (i + 0.5) / kGrid, v = (k + 0.5) / kGrid;
      const LightSample s = scene.sample(kReference, u, v);
      if (s.valid.v) sampled += 1 / double{s.pdf_sa.v};
      const double z = 2 * u - 1, r = std::sqrt(1 - z * z);
      const glm::dvec3 d(r * std::cos(kPi2 * v), r * std::sin(kPi2 * v), z);
      const auto t = distance_to_light(scene, kReference, d);
      if (!t) continue;
      seen += 4 * M_PI;
      const Float pdf = light_pdf_sa(scene.view, UInt(0u), lanes(kReference), lanes(d), float(*t), kOn);
      EXPECT_GT(pdf.v, 0.0f);
    }
  }
  EXPECT_NEAR(sampled / seen, 1, 0.01);
}

// --- closed forms over the plane z = 0, which looks up ---------------------------------------------------------------

const glm::dvec3 kUp(0, 0, 1);
const std::string kLookDown =
    R"(<transform name="to_world"><lookat origin="0,0,2" target="0,0,0" up="0,1,0"/></transform>)";

TEST(PointLight, FallsWithTheSquareOfTheDistanceAndTheCosine) {
  const LitScene scene(R"(<emitter type="point"><point name="position" x="0" y="0" z="2"/></emitter>)");
  EXPECT_NEAR(scene.irradiance({0, 0, 0}, kUp), 1.0 / 4, 1e-6);
  EXPECT_NEAR(scene.irradiance({3, 0, 0}, kUp), 2 / std::pow(13.0, 1.5), 1e-6);
  EXPECT_FALSE(scene.sample({0, 0, 2}, 0.5, 0.5).valid.v);
}

TEST(SpotLight, FallsLinearlyWithTheAngle) {
  const LitScene scene(
      R"(<emitter type="spot"><float name="intensity" value="8"/><float name="cutoff_angle" value="50"/>)"
      R"(<float name="beam_width" value="20"/>)" +
      kLookDown + "</emitter>");
  const double step = 30 * M_PI / 180;
  for (const double degrees : {0.0, 10.0, 19.9, 20.1, 35.0, 49.0, 50.1, 80.0}) {
    const double theta = degrees * M_PI / 180, falloff = std::clamp((50 - degrees) * M_PI / 180 / step, 0.0, 1.0);
    const double wanted = 8 * falloff * std::pow(std::cos(theta), 3) / 4;
    for (const double phi : {0.0, 2.0, 4.5}) {
      const double r = 2 * std::tan(theta);
      EXPECT_NEAR(scene.irradiance({r * std::cos(phi), r * std::sin(phi), 0}, kUp), wanted, 1e-4) << degrees;
    }
  }
  EXPECT_EQ(scene.irradiance({0, 0, 4}, -kUp), 0);  // behind it
  EXPECT_FALSE(scene.sample({0, 0, 2}, 0.5, 0.5).valid.v);
}

TEST(SpotLight, BeamAsWideAsTheConeHasAHardEdge) {
  const LitScene scene(
      R"(<emitter type="spot"><float name="cutoff_angle" value="45"/><float name="beam_width" value="45"/>)" +
      kLookDown + "</emitter>");
  EXPECT_NEAR(scene.irradiance({1.99, 0, 0}, kUp), std::pow(std::cos(std::atan(1.99 / 2)), 3) / 4, 1e-5);
  EXPECT_EQ(scene.irradiance({2.01, 0, 0}, kUp), 0);
}

/// Four texels, 1 2 over 3 4, as they are.
const norrsken::testing::Files kSlide = {
    {"slide.hdr", norrsken::testing::radiance_file(2, 2, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}})}};
std::string slide(const char* name) {
  return std::string("<texture name=\"") + name + R"(" type="bitmap"><string name="filename" value="slide.hdr"/>)" +
         R"(<string name="filter_type" value="nearest"/></texture>)";
}

TEST(SpotLight, TheTexturesSquareFitsTheCone) {
  const LitScene scene(
      R"(<emitter type="spot"><float name="cutoff_angle" value="45"/><float name="beam_width" value="45"/>)" +
          slide("texture") + kLookDown + "</emitter>",
      kSlide);
  // The lookat puts local +x at -x of the world and local +y at +y; u grows with local x, v with local y.
  const double share = std::pow(std::cos(std::atan(std::sqrt(2.0) / 2)), 3) / 4;
  EXPECT_NEAR(scene.irradiance({1, -1, 0}, kUp) / share, 1, 1e-4);
  EXPECT_NEAR(scene.irradiance({-1, -1, 0}, kUp) / share, 2, 1e-4);
  EXPECT_NEAR(scene.irradiance({1, 1, 0}, kUp) / share, 3, 1e-4);
  EXPECT_NEAR(scene.irradiance({-1, 1, 0}, kUp) / share, 4, 1e-4);
}

TEST(ProjectorLight, LightsAWallEvenly) {
  const LitScene scene(R"(<emitter type="projector"><float name="fov" value="90"/><float name="irradiance" value="3"/>)"
                       R"(<float name="scale" value="2"/>)" +
                       kLookDown + "</emitter>");
  for (const double x : {-1.99, -1.0, 0.0, 1.5}) {
    for (const double y : {-1.99, 0.3, 1.9}) EXPECT_NEAR(scene.irradiance({x, y, 0}, kUp), 6 * M_PI / 4, 1e-5);
  }
  EXPECT_EQ(scene.irradiance({2.01, 0, 0}, kUp), 0);
  EXPECT_EQ(scene.irradiance({0, -2.01, 0}, kUp), 0);
  EXPECT_EQ(scene.irradiance({0, 0, 4}, -kUp), 0);
}

TEST(ProjectorLight, ThrowsAPictureAsACameraSeesIt) {
  const LitScene scene(
      R"(<emitter type="projector"><float name="fov" value="90"/>)" + slide("irradiance") + kLookDown + "</emitter>",
      kSlide);
  // Looking down with +y up, +x is to the right: the picture's upper row is at +y, its first column at -x.
  EXPECT_NEAR(scene.irradiance({-1, 1, 0}, kUp), 1 * M_PI / 4, 1e-5);
  EXPECT_NEAR(scene.irradiance({1, 1, 0}, kUp), 2 * M_PI / 4, 1e-5);
  EXPECT_NEAR(scene.irradiance({-1, -1, 0}, kUp), 3 * M_PI / 4, 1e-5);
  EXPECT_NEAR(scene.irradiance({1, -1, 0}, kUp), 4 * M_PI / 4, 1e-5);
}

TEST(DirectionalLight, FallsWithTheCosineAlone) {
  const LitScene scene(R"(<emitter type="directional"><vector name="direction" x="3" y="0" z="-4"/>)"
                       R"(<float name="irradiance" value="10"/></emitter>)");
  for (const glm::dvec3& point : {glm::dvec3(0), glm::dvec3(0.5, -0.7, 0.1)}) {
    EXPECT_NEAR(scene.irradiance(point, kUp), 8, 1e-5);
    EXPECT_EQ(scene.irradiance(point, -kUp), 0);
  }
}

TEST(EnvmapEnvironment, LooksAlongTheDocumentedAxes) {
  // Rows stand on the poles; columns are centred on their share of a turn, the middle of the image is -z.
  const LitScene scene(kEnvmap + R"(<float name="scale" value="2"/></emitter>)", light_files());
  const auto seen = [&](const glm::dvec3& d) {
    return double{environment_seen(scene.view, lanes(glm::normalize(d)), kOn).radiance.r.v};
  };
  EXPECT_NEAR(seen({0, 1, 1e-6}), environment_texel(3, 0) + environment_texel(4, 0),
              1e-2);  // any column, in between; see below for texels
  for (int y = 0; y < kEnvironmentHeight; ++y) {
    for (int x = 0; x < kEnvironmentWidth; ++x) {
      const double phi = (x + 0.5) / kEnvironmentWidth * kPi2,
                   theta = std::max(1e-4, std::min(M_PI - 1e-4, y * M_PI / (kEnvironmentHeight - 1)));
      const glm::dvec3 d(std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta));
      EXPECT_NEAR(seen(d), 2 * environment_texel(x, y), 1e-3 * 512) << x << " " << y;
    }
  }
}

const std::string kCompensated = kEnvmap + R"(<boolean name="mis_compensation" value="true"/></emitter>)";

/// Half of the sphere of directions is left to surfaces, and yet nothing is lost.
TEST(EnvmapEnvironment, CompensationLeavesTheDarkToOthersAndLosesNothing) {
  statistics::StatisticalTest test;
  const LitScene plain(kEnvmap + "</emitter>", light_files()), compensated(kCompensated, light_files());
  const auto pdf = [&](const LitScene& scene, const glm::dvec3& d) {
    return double{light_pdf_sa(scene.view, UInt(0u), lanes(kReference), lanes(d), 1.0f, kOn).v};
  };
  const auto seen = [&](const glm::dvec3& d) {
    return double{environment_seen(plain.view, lanes(d), kOn).radiance.r.v};
  };
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0, 1 - 1e-7);
  const auto direction = [&] {
    const double y = 2 * unit(random) - 1, r = std::sqrt(1 - y * y), phi = kPi2 * unit(random);
    return glm::dvec3(r * std::cos(phi), y, r * std::sin(phi));
  };
  // Uniform directions against sampled light, by the power heuristic: the same mean, less noise.
  constexpr int kSamples = 200'000;
  statistics::Mean mean[2], seen_mean;
  double dark = 0;
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec3 d = direction();
    seen_mean.add(4 * M_PI * seen(d));
    dark += pdf(compensated, d) == 0 ? 1.0 / kSamples : 0;
    const double u = unit(random), v = unit(random);
    for (int k = 0; k < 2; ++k) {
      const LitScene& scene = k == 0 ? plain : compensated;
      const auto weight = [](double a, double b) { return a * a / (a * a + b * b); };
      const double uniform = 1 / (4 * M_PI);
      double value = seen(d) / uniform * weight(uniform, pdf(scene, d));
      const LightSample s = scene.sample(kReference, u, v);
      const double p = double{s.pdf_sa.v};
      if (s.valid.v) value += double{s.radiance.r.v} / p * weight(p, uniform);
      mean[k].add(value);
    }
  }
  EXPECT_GT(dark, 0.5);
  EXPECT_LT(dark, 0.99);
  const statistics::Estimate by_plain = mean[0].estimate(), by_compensated = mean[1].estimate();
  EXPECT_TRUE(test.agree(by_compensated, by_plain, "with compensation and without"));
  EXPECT_TRUE(test.agree(by_compensated, seen_mean.estimate(), "with compensation and by directions alone"));
  EXPECT_LT(by_compensated.variance, 0.9 * by_plain.variance);
}

TEST(EnvmapEnvironment, ItsMeanRadianceIsItsPower) {
  const LitScene scene(kEnvmap + "</emitter>", light_files());
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0, 1 - 1e-7);
  constexpr int kSamples = 200'000;
  statistics::StatisticalTest test;
  statistics::Mean sampled;
  for (int i = 0; i < kSamples; ++i) {
    const LightSample s = scene.sample(kReference, unit(random), unit(random));
    sampled.add(double{s.radiance.r.v} / double{s.pdf_sa.v} / (4 * M_PI));
  }
  double mean = 0;
  constexpr int kGrid = 1000;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const double y = (i + 0.5) / kGrid * 2 - 1, r = std::sqrt(1 - y * y), phi = (k + 0.5) / kGrid * kPi2;
      mean += double{environment_seen(scene.view, lanes({r * std::cos(phi), y, r * std::sin(phi)}), kOn).radiance.r.v} /
              (kGrid * kGrid);
    }
  }
  EXPECT_TRUE(test.agree(sampled.estimate(), mean, "mean radiance", 1e-3));
}

}  // namespace
}  // namespace norrsken::isa_host
