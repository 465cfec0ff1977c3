// Every kind of list.def: sampled directions against the density, and what arrives on a plane in closed form. A new kind
// needs a scene here, and if it is no delta function the distance at which a ray meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "light/light_testing.h"
#include "light/lit_scene_testing.h"

namespace norrsken::isa_host {
namespace {

constexpr double kPi2 = 2 * M_PI;
const glm::dvec3 kReference(0.3, -0.2, 0.1);

/// A mesh of these OBJ statements that shines.
LitScene mesh_light(const std::string& obj) {
  return LitScene(R"(<shape type="obj"><string name="filename" value="a.obj"/><emitter type="area"/></shape>)",
                  {{"a.obj", obj}});
}

/// An environment of 8 x 5 texels: dark and bright, black in places, at a pole too, and one as bright as a sun.
constexpr int kWidth = 8, kHeight = 5;
double texel(int x, int y) { return x == 6 && y == 1 ? 512 : (3 * x + 5 * y) % 4 == 0 ? 0 : (x * 7 + y * 3) % 5 / 4.0; }
norrsken::testing::Files environment_files() {
  std::vector<std::array<double, 3>> texels;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) texels.push_back({texel(x, y), texel(x, y) / 2, texel(x, y) / 4});
  }
  return {{"env.hdr", norrsken::testing::radiance_file(kWidth, kHeight, texels)}};
}
const std::string kEnvmap = R"(<emitter type="envmap"><string name="filename" value="env.hdr"/>)";

LitScene scene_of(LightKind kind) {
  switch (kind) {
    case LightKind::triangle:
      return mesh_light("v -1 -1 1\nv -1 2 1.5\nv 2 -1 1\nf 1 2 3\n");
    case LightKind::parallelogram:
      return LitScene(
          R"(<shape type="rectangle"><transform name="to_world"><scale x="1.5"/><rotate x="1" angle="160"/>)"
          R"(<translate z="1.2"/></transform><emitter type="area"/></shape>)");
    case LightKind::sphere:
      return LitScene(R"(<shape type="sphere"><point name="center" x="1" y="2" z="1"/><emitter type="area"/></shape>)");
    case LightKind::analytic:
      return LitScene(
          R"(<shape type="disk"><transform name="to_world"><scale x="1.3" y="0.8"/>)"
          R"(<rotate x="1" y="0.2" angle="160"/><translate z="1.1"/></transform><emitter type="area"/></shape>)");
    case LightKind::constant:
      return LitScene(R"(<emitter type="constant"/>)");
    case LightKind::envmap:
      return LitScene(
          kEnvmap + R"(<transform name="to_world"><rotate x="1" y="2" z="3" angle="40"/></transform></emitter>)",
          environment_files());
    default:
      ADD_FAILURE() << "a kind without a scene";
      return LitScene("");
  }
}

/// Where a ray from kReference meets the light's front.
std::optional<double> distance(const LitScene& scene, const glm::dvec3& direction) {
  const LightRecord& light = scene.light();
  const glm::dvec3 to_origin = doubles(light.origin) - kReference;
  if (light.kind == LightKind::constant || light.kind == LightKind::envmap) return 2.0 * double{scene.view.radius};
  if (light.kind == LightKind::sphere) {
    const double radius = light.edge1[0], b = glm::dot(to_origin, direction);
    const double d = b * b - glm::dot(to_origin, to_origin) + radius * radius;
    return d > 0 && b > 0 ? std::optional(b - std::sqrt(d)) : std::nullopt;
  }
  if (light.kind == LightKind::analytic) {
    const AnalyticRecord& shape = scene.compiled.tables().analytics[0];
    const auto local = [&](const glm::dvec3& v, double w) {
      glm::dvec3 out;
      for (int i = 0; i < 3; ++i) {
        const float* row = shape.place.local_from_world + 4 * i;
        out[i] = double{row[0]} * v.x + double{row[1]} * v.y + double{row[2]} * v.z + double{row[3]} * w;
      }
      return out;
    };
    const glm::dvec3 o = local(kReference, 1), d = local(direction, 0);
    if (shape.kind == AnalyticKind::disk) {
      const double t = -o.z / d.z, x = o.x + t * d.x, y = o.y + t * d.y;
      return d.z < 0 && t > 0 && x * x + y * y <= 1 ? std::optional(t) : std::nullopt;
    }
    // The entry into the unit cylinder; behind it is the back, which does not shine.
    const double a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y, c = o.x * o.x + o.y * o.y - 1;
    const double t = (-b - std::sqrt(b * b - a * c)) / a, z = o.z + t * d.z;
    return t > 0 && z >= 0 && z <= 1 ? std::optional(t) : std::nullopt;
  }
  const glm::dvec3 normal = doubles(light.normal), e1 = doubles(light.edge1), e2 = doubles(light.edge2);
  const double facing = -glm::dot(direction, normal), t = -glm::dot(to_origin, normal) / facing;
  if (!(facing > 0 && t > 0)) return std::nullopt;
  const glm::dvec3 q = t * direction - to_origin;
  const double b1 = glm::dot(glm::cross(q, e2), normal) / glm::dot(glm::cross(e1, e2), normal);
  const double b2 = glm::dot(glm::cross(e1, q), normal) / glm::dot(glm::cross(e1, e2), normal);
  const bool inside = light.kind == LightKind::triangle ? b1 + b2 <= 1 : b1 <= 1 && b2 <= 1;
  return b1 >= 0 && b2 >= 0 && inside ? std::optional(t) : std::nullopt;
}

/// Sampled directions against the density, and its integral.
void expect_directions_follow_density(const LitScene& scene) {
  const auto pdf = [&](const glm::dvec3& d) {
    const auto t = distance(scene, d);
    return t ? double{light_pdf_sa(scene.view, UInt(0u), lanes(kReference), lanes(d), float(*t), kOn).v} : 0.0;
  };
  constexpr int kRows = 24, kColumns = 48, kSamples = 200'000, kInner = 24;
  std::vector<double> observed(kRows * kColumns), expected(kRows * kColumns);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1 - 1e-7);
  for (int i = 0; i < kSamples; ++i) {
    const double u = unit(random), v = unit(random);
    const LightSample s = scene.sample(kReference, u, v);
    ASSERT_TRUE(s.valid.v);
    const glm::dvec3 d = glm::normalize(doubles(s.point) - kReference);
    const int row = std::clamp(int((d.z + 1) / 2 * kRows), 0, kRows - 1);
    const int column = std::clamp(int((std::atan2(d.y, d.x) / kPi2 + 0.5) * kColumns), 0, kColumns - 1);
    ++observed[std::size_t(row * kColumns + column)];
    if (i >= 1000) continue;
    // Beside the edge of the light the ray may miss it.
    if (const double of_direction = pdf(d); of_direction > 0) {
      EXPECT_NEAR(double{s.pdf_sa.v}, of_direction, 2e-3 * of_direction) << u << " " << v;
    }
  }
  double integral = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      double cell = 0;
      for (int i = 0; i < kInner; ++i) {
        for (int k = 0; k < kInner; ++k) {
          const double z = (row + (i + 0.5) / kInner) / kRows * 2 - 1, r = std::sqrt(1 - z * z);
          const double phi = ((column + (k + 0.5) / kInner) / kColumns - 0.5) * kPi2;
          cell += pdf({r * std::cos(phi), r * std::sin(phi), z});
        }
      }
      cell *= 4 * M_PI / (kRows * kColumns * kInner * kInner);
      integral += cell;
      expected[std::size_t(row * kColumns + column)] = cell * kSamples;
    }
  }
  EXPECT_NEAR(integral, 1, 2e-3);
  double chi2 = 0;
  int cells = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] < 10) continue;
    chi2 += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    ++cells;
  }
  // Wilson and Hilferty's approximation.
  const double n = cells - 1;
  EXPECT_LT((std::cbrt(chi2 / n) - (1 - 2 / (9 * n))) / std::sqrt(2 / (9 * n)), 4.0)
      << "chi2 " << chi2 << " of " << cells << " cells";
}

template <LightKind light_kind, class Model, bool is_delta>
struct Case {
  static constexpr LightKind kKind = light_kind;
  static constexpr bool kDelta = is_delta;
};

template <class C>
class EveryLight : public ::testing::Test {};
using Cases = ::testing::Types<
#define NORRSKEN_LIGHT(kind, Model, is_delta) Case<LightKind::kind, Model, is_delta>,
#include "light/list.def"
#undef NORRSKEN_LIGHT
    Case<LightKind::count, void, true>>;
TYPED_TEST_SUITE(EveryLight, Cases);

TYPED_TEST(EveryLight, DirectionsFollowTheDensity) {
  if constexpr (TypeParam::kDelta) {
    GTEST_SKIP() << "a delta has no density";
  } else {
    expect_directions_follow_density(scene_of(TypeParam::kKind));
  }
}

TEST(EnvmapEnvironment, DirectionsFollowTheCompensatedDensity) {
  expect_directions_follow_density(
      LitScene(kEnvmap + R"(<boolean name="mis_compensation" value="true"/></emitter>)", environment_files()));
}

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
      const auto t = distance(scene, d);
      if (!t) continue;
      seen += 4 * M_PI;
      const Float pdf = light_pdf_sa(scene.view, UInt(0u), lanes(kReference), lanes(d), float(*t), kOn);
      EXPECT_GT(pdf.v, 0.0f);
    }
  }
  EXPECT_NEAR(sampled / seen, 1, 0.01);
}

TYPED_TEST(EveryLight, IsFoundWhereItIsSeen) {
  if constexpr (TypeParam::kKind == LightKind::constant || TypeParam::kKind == LightKind::envmap) {
    const LitScene scene = scene_of(TypeParam::kKind);
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> unit(0, 1 - 1e-7);
    for (int i = 0; i < 1000; ++i) {
      const LightSample s = scene.sample(kReference, unit(random), unit(random));
      const glm::dvec3 to_light = doubles(s.point) - kReference;
      EXPECT_NEAR(glm::length(to_light), 2 * double{scene.view.radius}, 1e-4);
      const double seen = double{environment_radiance(scene.view, lanes(glm::normalize(to_light)), kOn).y.v};
      EXPECT_NEAR(double{s.radiance.y.v}, seen, 2e-3 * seen + 1e-5);
    }
  } else {
    GTEST_SKIP() << "no environment";
  }
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
  const LitScene scene(kEnvmap + R"(<float name="scale" value="2"/></emitter>)", environment_files());
  const auto seen = [&](const glm::dvec3& d) {
    return double{environment_radiance(scene.view, lanes(glm::normalize(d)), kOn).x.v};
  };
  EXPECT_NEAR(seen({0, 1, 1e-6}), texel(3, 0) + texel(4, 0), 1e-2);  // any column, in between; see below for texels
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double phi = (x + 0.5) / kWidth * kPi2,
                   theta = std::max(1e-4, std::min(M_PI - 1e-4, y * M_PI / (kHeight - 1)));
      const glm::dvec3 d(std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta));
      EXPECT_NEAR(seen(d), 2 * texel(x, y), 1e-3 * 512) << x << " " << y;
    }
  }
}

const std::string kCompensated = kEnvmap + R"(<boolean name="mis_compensation" value="true"/></emitter>)";

/// Half of the sphere of directions is left to surfaces, and yet nothing is lost.
TEST(EnvmapEnvironment, CompensationLeavesTheDarkToOthersAndLosesNothing) {
  const LitScene plain(kEnvmap + "</emitter>", environment_files()), compensated(kCompensated, environment_files());
  const auto pdf = [&](const LitScene& scene, const glm::dvec3& d) {
    return double{light_pdf_sa(scene.view, UInt(0u), lanes(kReference), lanes(d), 1.0f, kOn).v};
  };
  const auto seen = [&](const glm::dvec3& d) { return double{environment_radiance(plain.view, lanes(d), kOn).x.v}; };
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0, 1 - 1e-7);
  const auto direction = [&] {
    const double y = 2 * unit(random) - 1, r = std::sqrt(1 - y * y), phi = kPi2 * unit(random);
    return glm::dvec3(r * std::cos(phi), y, r * std::sin(phi));
  };
  // Uniform directions against sampled light, by the power heuristic: the same mean, less noise.
  constexpr int kSamples = 200'000;
  double mean[2]{}, square[2]{}, dark = 0, expected = 0;
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec3 d = direction();
    expected += seen(d) / kSamples;
    dark += pdf(compensated, d) == 0 ? 1.0 / kSamples : 0;
    const double u = unit(random), v = unit(random);
    for (int k = 0; k < 2; ++k) {
      const LitScene& scene = k == 0 ? plain : compensated;
      const auto weight = [](double a, double b) { return a * a / (a * a + b * b); };
      const double uniform = 1 / (4 * M_PI);
      double value = seen(d) / uniform * weight(uniform, pdf(scene, d));
      const LightSample s = scene.sample(kReference, u, v);
      const double p = double{s.pdf_sa.v};
      if (s.valid.v) value += double{s.radiance.x.v} / p * weight(p, uniform);
      mean[k] += value / kSamples, square[k] += value * value / kSamples;
    }
  }
  EXPECT_GT(dark, 0.5);
  EXPECT_LT(dark, 0.99);
  double deviation[2];
  for (int k = 0; k < 2; ++k) deviation[k] = std::sqrt((square[k] - mean[k] * mean[k]) / kSamples);
  EXPECT_LT(std::abs(mean[0] - mean[1]), 4 * std::hypot(deviation[0], deviation[1]));
  EXPECT_NEAR(mean[1] / (4 * M_PI * expected), 1, 0.03);
  EXPECT_LT(deviation[1], 0.95 * deviation[0]) << deviation[0] << " " << deviation[1];
}

TEST(EnvmapEnvironment, ItsMeanRadianceIsItsPower) {
  const LitScene scene(kEnvmap + "</emitter>", environment_files());
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0, 1 - 1e-7);
  constexpr int kSamples = 20'000;
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const LightSample s = scene.sample(kReference, unit(random), unit(random));
    sum += double{s.radiance.x.v} / double{s.pdf_sa.v} / kSamples;
  }
  double mean = 0;
  constexpr int kGrid = 1000;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const double y = (i + 0.5) / kGrid * 2 - 1, r = std::sqrt(1 - y * y), phi = (k + 0.5) / kGrid * kPi2;
      mean += double{environment_radiance(scene.view, lanes({r * std::cos(phi), y, r * std::sin(phi)}), kOn).x.v} /
              (kGrid * kGrid);
    }
  }
  EXPECT_NEAR(sum / (4 * M_PI), mean, 0.01 * mean);
}

}  // namespace
}  // namespace norrsken::isa_host
