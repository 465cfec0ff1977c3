// Every kind of light: directions towards it against their density, in the measures of solid angle and of area; rays from
// it, position times direction, and that they carry the light that next-event estimation finds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "light/emit_lights.h"
#include "light/every_light_testing.h"
#include "tests/statistics/statistical_test.h"
#include "tests/statistics/suite.h"

namespace norrsken::isa_host {
namespace {

using statistics::Random;
using statistics::StatisticalTest;

/// Where light arrives.
const glm::dvec3 kReferences[] = {{0.3, -0.2, 0.1}, {-0.5, 0.4, -0.3}};
static_assert(std::size(kReferences) == statistics::kLightReferences);

std::string caption(const LightCase& c, const std::string& what) {
  return std::string(c.kind_name) + ", " + std::string(c.name) + ", " + what;
}
std::string caption(const LightCase& c, const glm::dvec3& p) {
  return caption(c, "seen from " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z));
}
Vec2f pair(Random& random) {
  const float x = random(), y = random();
  return {Float(x), Float(y)};
}

/// Of a direction from `from`.
double pdf_sa(const LitScene& scene, const glm::dvec3& from, const glm::dvec3& direction) {
  const auto t = distance_to_light(scene, from, direction);
  return t ? double{light_pdf_sa(scene.view, UInt(0u), lanes(from), lanes(direction), float(*t), kOn).v} : 0.0;
}

TEST_P(EveryLight, DirectionsFollowTheDensity) {
  StatisticalTest test;
  const LitScene scene = scene_of(GetParam());
  ASSERT_EQ(scene.light().kind, GetParam().kind);
  for (const glm::dvec3& from : kReferences) {
    if (GetParam().is_delta) {
      test.skip(statistics::kPerDensity);
      continue;
    }
    const auto sampling = statistics::sampling_of_directions(
        [&](Random& random) -> std::optional<statistics::Direction> {
          const float u = random(), v = random();
          const LightSample s = scene.sample(from, double{u}, double{v});
          if (!s.valid.v) return std::nullopt;
          const glm::dvec3 d = glm::normalize(doubles(s.point) - from);
          return statistics::Direction{d.x, d.y, d.z};
        },
        [&](const statistics::Direction& d) {
          return pdf_sa(scene, from, {d[0], d[1], d[2]});
        });
    EXPECT_TRUE(test.follows_density(sampling, caption(GetParam(), from)));

    // The density that comes with a sample. Beside the light's edge the ray may miss it; towards the outline of a curved
    // surface, where the density grows without bound, that of the nearest float is another.
    Random random(8);
    for (int i = 0; i < 1000; ++i) {
      const float u = random(), v = random();
      const LightSample s = scene.sample(from, double{u}, double{v});
      if (!s.valid.v) continue;
      const double of_direction = pdf_sa(scene, from, glm::normalize(doubles(s.point) - from));
      const bool at_outline = GetParam().kind == LightKind::analytic && of_direction > 10;
      if (of_direction > 0 && !at_outline) {
        EXPECT_NEAR(double{s.pdf_sa.v}, of_direction, 2e-3 * of_direction) << u << " " << v;
      }
    }
  }
}

TEST_P(EveryLight, DeltasAreFoundInOneDirectionAndByNoOther) {
  if (!GetParam().is_delta) GTEST_SKIP() << "it has a density";
  const LitScene scene = scene_of(GetParam());
  Random random(9);
  for (const glm::dvec3& from : kReferences) {
    const LightSample first = scene.sample(from, 0.5, 0.5);
    for (int i = 0; i < 1000; ++i) {
      const float u = random(), v = random();
      const LightSample s = scene.sample(from, double{u}, double{v});
      ASSERT_EQ(s.valid.v, first.valid.v);
      ASSERT_EQ(doubles(s.point), doubles(first.point));
      ASSERT_EQ(doubles(s.radiance), doubles(first.radiance));
      ASSERT_EQ(s.pdf_sa.v, 1.0f);
      const auto d = statistics::sphere_direction({double{random()} - 0.5, 2 * double{random()} - 1});
      ASSERT_EQ(light_pdf_sa(scene.view, UInt(0u), lanes(from), lanes({d[0], d[1], d[2]}), 1.0f, kOn).v, 0.0f);
    }
  }
}

TEST_P(EveryLight, EnvironmentsAreFoundWhereTheyAreSeen) {
  const LitScene scene = scene_of(GetParam());
  if (scene.view.environment == kNone) GTEST_SKIP() << "no environment";
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const float u = random(), v = random();
    const LightSample s = scene.sample(kReferences[0], double{u}, double{v});
    const glm::dvec3 to_light = doubles(s.point) - kReferences[0];
    EXPECT_NEAR(glm::length(to_light), 2 * double{scene.view.radius}, 1e-4);
    const double seen = double{environment_seen(scene.view, lanes(glm::normalize(to_light)), kOn).radiance.g.v};
    EXPECT_NEAR(double{s.radiance.g.v}, seen, 2e-3 * seen + 1e-5);
  }
}

// --- rays from lights -------------------------------------------------------------------------------------------------

EmittedRay emit(const LitScene& scene, Random& random) {
  const Vec2f position = pair(random), direction = pair(random);
  return emit_from_lights(scene.view, {Float(0.0f), Float(0.0f)}, position, direction, kOn);
}

using Square = std::array<double, 2>;

/// Height and azimuth around an axis: uniform for uniform directions.
struct Around {
  glm::dvec3 s, t, axis;
  explicit Around(const glm::dvec3& a) : axis(glm::normalize(a)) {
    s = glm::normalize(glm::cross(axis, std::abs(axis.x) > 0.6 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    t = glm::cross(axis, s);
  }
  double turn(const glm::dvec3& d) const { return std::atan2(glm::dot(d, t), glm::dot(d, s)) / (2 * M_PI) + 0.5; }
  double height(const glm::dvec3& d) const { return glm::dot(d, axis); }
};

/// A ray in coordinates in which all that the light may send is uniform over [0, 1): where it begins and where it goes.
/// Nothing of what is the same for all rays, or is no uniform choice.
struct Uniform {
  std::optional<Square> position, direction;
  glm::dvec3 normal{};  ///< of the surface, if there is one
};

Uniform on_surface(const LitScene& scene, LightKind kind, const glm::dvec3& origin) {
  const LightRecord& light = scene.light();
  switch (kind) {
    case LightKind::triangle:
    case LightKind::triangle_normals: {
      const auto [b1, b2] = barycentric(light, origin);
      return {Square{b1 / (1 - b2), (1 - b2) * (1 - b2)}, {}, doubles(light.normal)};
    }
    case LightKind::parallelogram:
    case LightKind::parallelogram_normals:
      return {barycentric(light, origin), {}, doubles(light.normal)};
    case LightKind::sphere:
    case LightKind::sphere_normals: {
      const glm::dvec3 n = glm::normalize(origin - doubles(light.origin));
      const Around z({0, 0, 1});
      return {Square{(z.height(n) + 1) / 2, z.turn(n)}, {}, light.edge1[1] > 0 ? -n : n};
    }
    default: {
      const glm::dvec3 p = local_of(scene, origin, 1);
      const double turn = Around({0, 0, 1}).turn(p);
      const glm::dvec3 local = is_disk(scene) ? glm::dvec3(0, 0, 1) : glm::dvec3(p.x, p.y, 0);
      // Normals go through the transpose of what takes points to the local space.
      glm::dvec3 normal;
      for (int k = 0; k < 3; ++k) {
        glm::dvec3 axis(0);
        axis[k] = 1;
        normal[k] = glm::dot(local, local_of(scene, axis, 0));
      }
      return {Square{is_disk(scene) ? p.x * p.x + p.y * p.y : p.z, turn}, {}, glm::normalize(normal)};
    }
  }
}

Uniform uniform_coordinates(const LitScene& scene, const EmittedRay& ray) {
  const LightRecord& light = scene.light();
  const glm::dvec3 origin = doubles(ray.origin), d = doubles(ray.direction);
  const glm::dvec3 x = doubles(light.edge1), y = doubles(light.edge2), z = doubles(light.normal);
  const float* parameters = scene.view.parameters + light.parameters;
  switch (light.kind) {
    case LightKind::triangle:
    case LightKind::parallelogram:
    case LightKind::sphere:
    case LightKind::analytic: {
      Uniform u = on_surface(scene, light.kind, origin);
      const Around n(u.normal);
      u.direction = Square{n.height(d) * n.height(d), n.turn(d)};  // of a cosine-weighted direction
      EXPECT_GE(n.height(d), -1e-5);
      return u;
    }
    case LightKind::triangle_normals:
    case LightKind::parallelogram_normals:
    case LightKind::sphere_normals:
    case LightKind::analytic_normals: {
      const Uniform u = on_surface(scene, light.kind, origin);
      EXPECT_LT(glm::length(d - u.normal), 1e-3);
      return u;
    }
    case LightKind::point:
      return {{}, Square{(d.z + 1) / 2, Around({0, 0, 1}).turn(d)}};
    case LightKind::spot: {
      const glm::dvec3 local = glm::normalize(glm::dvec3(glm::dot(x, d), glm::dot(y, d), glm::dot(z, d)));
      const double cos_cutoff{parameters[1]};
      return {{}, Square{(local.z - cos_cutoff) / (1 - cos_cutoff), Around({0, 0, 1}).turn(local)}};
    }
    case LightKind::projector: {
      const double ahead = glm::dot(z, d), width{parameters[0]}, height{parameters[1]};
      return {{}, Square{(glm::dot(x, d) / ahead / width + 1) / 2, (glm::dot(y, d) / ahead / height + 1) / 2}};
    }
    case LightKind::directional:
    case LightKind::constant:
    case LightKind::envmap: {
      // From a disk that touches the sphere around the scene.
      const double radius{scene.view.radius};
      const glm::dvec3 offset = (origin - doubles(scene.view.center)) / radius;
      const Around axis(-d);
      EXPECT_NEAR(axis.height(offset), 1, 1e-4);
      const glm::dvec3 on_disk = offset - axis.axis;
      Uniform u{Square{glm::dot(on_disk, on_disk), axis.turn(on_disk)}, {}};
      if (light.kind == LightKind::constant) u.direction = Square{(d.z + 1) / 2, Around({0, 0, 1}).turn(d)};
      return u;
    }
    default:
      ADD_FAILURE() << "a kind of light whose rays nothing is known about";
      return {};
  }
}

TEST_P(EveryLight, RaysFollowPositionTimesDirection) {
  constexpr int kSamples = 1'000'000, kSide = 16, kDirectionSide = 4;
  StatisticalTest test;
  const LitScene scene = scene_of(GetParam());
  Random random(5);
  std::optional<statistics::EvenCells> cells;
  const auto cell = [](const Square& at, int side) {
    const auto clamped = [&](double v) { return std::clamp(static_cast<int>(v * side), 0, side - 1); };
    return clamped(at[1]) * side + clamped(at[0]) + 0.5;
  };
  for (int i = 0; i < kSamples; ++i) {
    const EmittedRay ray = emit(scene, random);
    ASSERT_TRUE(ray.valid.v || GetParam().kind == LightKind::spot || GetParam().kind == LightKind::envmap);
    if (!ray.valid.v) continue;
    const Uniform u = uniform_coordinates(scene, ray);
    // Joint, so that dependence of one on the other shows; one alone may be looked at more closely.
    const int direction_side = u.position ? kDirectionSide : kSide;
    const double columns = u.position ? kSide * kSide : 1, rows = u.direction ? direction_side * direction_side : 1;
    if (!cells) cells.emplace(statistics::Rectangle{{0, 0}, {columns, rows}}, int(columns), int(rows));
    for (const auto& coordinates : {u.position, u.direction}) {
      for (const double v : coordinates.value_or(Square{})) ASSERT_TRUE(v > -1e-3 && v < 1 + 1e-3) << v;
    }
    cells->add({u.position ? cell(*u.position, kSide) : 0.5, u.direction ? cell(*u.direction, direction_side) : 0.5});
  }
  EXPECT_TRUE(test.chi_square(cells->cells(), {"cell of positions", "cell of directions"},
                              caption(GetParam(), "rays from it")));
}

/// The density over solid angle, taken to the area by cosine and distance, integrates to the share of samples that come:
/// one, but for surfaces that are sampled where they face away too. Uniform points of the area are where rays begin.
TEST_P(EveryLight, DensityOverTheAreaIntegratesToOne) {
  constexpr int kSamples = 100'000;
  StatisticalTest test;
  const LitScene scene = scene_of(GetParam());
  const bool around = GetParam().kind == LightKind::constant || GetParam().kind == LightKind::envmap;
  for (const glm::dvec3& from : kReferences) {
    if (GetParam().is_delta || around) {
      test.skip(1);
      continue;
    }
    Random random(6);
    statistics::Mean mean, came;
    for (int i = 0; i < kSamples; ++i) {
      const float u = random(), v = random();
      came.add(scene.sample(from, double{u}, double{v}).valid.v ? 1 : 0);
      const EmittedRay ray = emit(scene, random);
      const glm::dvec3 to_light = doubles(ray.origin) - from;
      const double distance = glm::length(to_light);
      const glm::dvec3 direction = to_light / distance;
      const double cosine = -glm::dot(direction, on_surface(scene, GetParam().kind, doubles(ray.origin)).normal);
      if (cosine <= 0) {
        mean.add(0);
        continue;
      }
      const Float pdf = light_pdf_sa(scene.view, UInt(0u), lanes(from), lanes(direction), float(distance), kOn);
      mean.add(double{pdf.v} * cosine / (distance * distance) * double{scene.light().area});
    }
    EXPECT_TRUE(test.agree(mean.estimate(), came.estimate(), caption(GetParam(), from), 1e-4));
    EXPECT_TRUE(came.estimate().mean == 1 || GetParam().kind == LightKind::analytic);
  }
}

/// A rectangle that looks along the cross product of its edges.
struct Receiver {
  glm::dvec3 corner, e1, e2;

  glm::dvec3 normal() const { return glm::normalize(glm::cross(e1, e2)); }
  double area() const { return glm::length(glm::cross(e1, e2)); }
  bool is_hit(const glm::dvec3& o, const glm::dvec3& d) const {
    const glm::dvec3 n = glm::cross(e1, e2);
    const double t = glm::dot(corner - o, n) / glm::dot(d, n);
    if (!(glm::dot(d, n) < 0 && t > 0)) return false;
    const glm::dvec3 q = o + t * d - corner;
    const double u = glm::dot(q, e1) / glm::dot(e1, e1), v = glm::dot(q, e2) / glm::dot(e2, e2);
    return u >= 0 && u < 1 && v >= 0 && v < 1;
  }
};
/// Within a sphere of radius 1, which is what environments know of a scene.
const Receiver kReceivers[] = {
    {{-0.65, -0.65, 0}, {0.65, 0, 0}, {0, 0.65, 0}}, {{0, -0.65, 0}, {0.65, 0, 0}, {0, 0.65, 0}},
    {{-0.65, 0, 0}, {0.65, 0, 0}, {0, 0.65, 0}},     {{0, 0, 0}, {0.65, 0, 0}, {0, 0.65, 0}},
    {{0, -0.65, -0.65}, {0, 1.3, 0}, {0, 0, 1.3}},   {{0, -0.65, -0.65}, {0, 0, 1.3}, {0, 1.3, 0}}};
static_assert(std::size(kReceivers) == statistics::kLightReceivers);

TEST_P(EveryLight, RaysCarryWhatNextEventEstimationFinds) {
  constexpr int kRays = 1'000'000, kPoints = 100'000;
  StatisticalTest test;
  const LitScene scene = scene_of(GetParam());
  statistics::Mean carried[std::size(kReceivers)];
  Random random(7);
  for (int i = 0; i < kRays; ++i) {
    const EmittedRay ray = emit(scene, random);
    const glm::dvec3 o = doubles(ray.origin), d = doubles(ray.direction);
    for (std::size_t k = 0; k < std::size(kReceivers); ++k) {
      carried[k].add(ray.valid.v && kReceivers[k].is_hit(o, d) ? double{ray.weight.r.v} : 0);
    }
  }
  int lit = 0;
  for (std::size_t k = 0; k < std::size(kReceivers); ++k) {
    const Receiver& receiver = kReceivers[k];
    statistics::Mean found;
    for (int i = 0; i < kPoints; ++i) {
      const double a{random()}, b{random()};
      const glm::dvec3 p = receiver.corner + a * receiver.e1 + b * receiver.e2;
      const float u = random(), v = random();
      const LightSample s = scene.sample(p, double{u}, double{v});
      const double cosine = glm::dot(receiver.normal(), glm::normalize(doubles(s.point) - p));
      found.add(s.valid.v && cosine > 0 ? double{s.radiance.r.v} / double{s.pdf_sa.v} * cosine * receiver.area() : 0);
    }
    const bool along_normals = found.estimate().mean == 0 && GetParam().kind_name.ends_with("_normals");
    if (along_normals) {
      test.skip(1);  // nothing but its own rays finds it: directionalarea_test.cpp
      continue;
    }
    lit += found.estimate().mean > 0 ? 1 : 0;
    EXPECT_TRUE(test.agree(carried[k].estimate(), found.estimate(),
                           caption(GetParam(), "flux through receiver " + std::to_string(k)), 1e-5));
  }
  EXPECT_TRUE(lit >= 3 || GetParam().kind_name.ends_with("_normals")) << "too few receivers see the light";
}

INSTANTIATE_TEST_SUITE_P(Cases, EveryLight, ::testing::ValuesIn(kLightCaseTable), light_test_name);

}  // namespace
}  // namespace norrsken::isa_host
