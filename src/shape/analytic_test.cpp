// The kernels of disk and cylinder, one lane at a time, against arithmetic in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>

#include "shape/models.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

constexpr float kFar = 1e30f;

glm::dvec3 to_dvec(const Vec3f& v) { return {v.x.v, v.y.v, v.z.v}; }
Vec3f to_lanes(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
/// The shape's distance from a point; zero on it.
double off_surface(DiskShape, const glm::dvec3& p) {
  return std::max(std::abs(p.z), std::max(0.0, std::hypot(p.x, p.y) - 1));
}
double off_surface(CylinderShape, const glm::dvec3& p) {
  return std::max({std::abs(std::hypot(p.x, p.y) - 1), -p.z, p.z - 1});
}
/// Where (u, v) is, by the parameterisation.
glm::dvec3 at(DiskShape, double u, double v) {
  const double phi = 2 * std::numbers::pi * v;
  return {u * std::cos(phi), u * std::sin(phi), 0};
}
glm::dvec3 at(CylinderShape, double u, double v) {
  const double phi = 2 * std::numbers::pi * u;
  return {std::cos(phi), std::sin(phi), v};
}

/// The nearest crossing of the ray, in double precision: infinity if there is none.
double reference(DiskShape, const glm::dvec3& o, const glm::dvec3& d) {
  const double t = -o.z / d.z;
  return t > 0 && glm::length(glm::dvec2(o + t * d)) <= 1 ? t : INFINITY;
}
double reference(CylinderShape, const glm::dvec3& o, const glm::dvec3& d) {
  const double a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y, c = o.x * o.x + o.y * o.y - 1;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return INFINITY;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (-b + sign * std::sqrt(discriminant)) / a;
    if (t > 0 && o.z + t * d.z >= 0 && o.z + t * d.z <= 1) return t;
  }
  return INFINITY;
}

template <class Shape>
class Analytic : public ::testing::Test {};
using Shapes = ::testing::Types<DiskShape, CylinderShape>;
TYPED_TEST_SUITE(Analytic, Shapes);

template <class... Tested>
constexpr bool is_among(const ::testing::Types<Tested...>*, auto shape) {
  return (std::is_same_v<Tested, decltype(shape)> || ...);
}
#define NORRSKEN_ANALYTIC(kind, Model)                                                     \
  static_assert(!kCanBeSampled<Model> || is_among(static_cast<Shapes*>(nullptr), Model{}), \
                "a shape whose area is sampled has to be among those that are tested here: " #kind);
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC

TYPED_TEST(Analytic, IsHitWhereDoublePrecisionHitsIt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  int hits = 0, disagree = 0;
  constexpr int kRays = 200000;
  for (int i = 0; i < kRays; ++i) {
    // From inside and outside; directions of any length.
    const double reach = i % 2 == 0 ? 1.5 : 6;
    const Vec3f o = to_lanes(reach * glm::dvec3(unit(random), unit(random), unit(random)));
    const Vec3f d = to_lanes((i % 3 + 0.1) * glm::dvec3(unit(random), unit(random), unit(random)) - 0.2 * to_dvec(o));
    const double expected = reference(TypeParam{}, to_dvec(o), to_dvec(d));
    const LocalHit hit = TypeParam::intersect(o, d, kFar);
    if (hit.hit.v != std::isfinite(expected)) {
      ++disagree;
      continue;
    }
    if (!hit.hit.v) continue;
    ++hits;
    const double length = glm::length(to_dvec(d));
    // Grazing rays amplify rounding: the crossing is on the surface all the same.
    EXPECT_LT(off_surface(TypeParam{}, to_dvec(o) + double{hit.t.v} * to_dvec(d)), 1e-5 * (1 + reach)) << i;
    EXPECT_NEAR(hit.t.v * length, expected * length, 3e-3 * (1 + expected * length)) << i;
  }
  EXPECT_GT(hits, kRays / 20);
  EXPECT_LT(disagree, kRays / 20000);  // at edges
}

TYPED_TEST(Analytic, CrossingsEndAtTheLimit) {
  const Vec3f o{0.25f, 0.125f, 0.5f}, d{0.5f, 0.25f, std::is_same_v<TypeParam, DiskShape> ? -0.5f : -0.25f};
  const LocalHit hit = TypeParam::intersect(o, d, kFar);
  ASSERT_TRUE(hit.hit.v);
  EXPECT_FALSE(TypeParam::intersect(o, d, hit.t).hit.v);
  EXPECT_TRUE(TypeParam::intersect(o, d, hit.t * Float(1.00001f)).hit.v);
  EXPECT_FALSE(TypeParam::intersect(o, -d, hit.t * Float(0.5f)).hit.v);
}

TYPED_TEST(Analytic, ParameterisationNormalsAndTangentsFit) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.02, 0.98);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 1000; ++i) {
    const double u = unit(random), v = unit(random);
    const glm::dvec3 p = at(TypeParam{}, u, v);
    const LocalSurface s = TypeParam::surface_at(to_lanes(p * (1 + 1e-6)));
    EXPECT_LT(off_surface(TypeParam{}, to_dvec(s.position)), 2e-6);
    EXPECT_NEAR(s.uv.x.v, u, 3e-6);
    EXPECT_NEAR(s.uv.y.v, v, 3e-6);
    EXPECT_NEAR(glm::length(to_dvec(s.normal)), 1, 1e-6);
    const glm::dvec3 du = (at(TypeParam{}, u + kStep, v) - at(TypeParam{}, u - kStep, v)) / (2 * kStep);
    glm::dvec3 dv = (at(TypeParam{}, u, v + kStep) - at(TypeParam{}, u, v - kStep)) / (2 * kStep);
    if (std::is_same_v<TypeParam, DiskShape>) dv = glm::normalize(dv);  // as in Mitsuba
    EXPECT_LT(glm::length(to_dvec(s.dp_du) - du), 1e-5);
    EXPECT_LT(glm::length(to_dvec(s.dp_dv) - dv), 1e-5);
    EXPECT_LT(glm::length(glm::normalize(glm::cross(du, dv)) - to_dvec(s.normal)), 1e-5);
  }
}

TYPED_TEST(Analytic, SamplesAreUniformOverTheArea) {
  // A grid of equal areas, by the parameterisation: of the disk rings of equal area, of the cylinder bands.
  constexpr int kCells = 32, kSamples = 1'000'000;
  statistics::StatisticalTest test;
  statistics::EvenCells cells({{0, 0}, {1, 1}}, kCells, kCells);
  statistics::Random random(3);
  for (int i = 0; i < kSamples; ++i) {
    const float a = random(), b = random();
    const LocalPoint point = TypeParam::sample({Float(a), Float(b)});
    const LocalSurface s = TypeParam::surface_at(point.position);
    ASSERT_LT(off_surface(TypeParam{}, to_dvec(point.position)), 1e-6);
    ASSERT_LT(glm::length(to_dvec(point.normal) - to_dvec(s.normal)), 1e-6);
    const double u = s.uv.x.v, v = s.uv.y.v;
    cells.add({std::is_same_v<TypeParam, DiskShape> ? u * u : u, v});
  }
  EXPECT_TRUE(test.chi_square(cells.cells(), {"u, u^2 of the disk", "v"}, "points of the area"));
}

TEST(DiskKernel, CentreHasACoordinateSystem) {
  const LocalSurface s = DiskShape::surface_at({0.0f, 0.0f, 0.0f});
  EXPECT_EQ(s.uv.x.v, 0);
  EXPECT_EQ(s.uv.y.v, 0);
  EXPECT_EQ(to_dvec(s.dp_du), glm::dvec3(1, 0, 0));
  EXPECT_EQ(to_dvec(s.dp_dv), glm::dvec3(0, 1, 0));
}

TEST(DiskKernel, RaysInItsPlanePassBy) {
  EXPECT_FALSE(DiskShape::intersect({-2.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, kFar).hit.v);
  EXPECT_FALSE(DiskShape::intersect({-2.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}, kFar).hit.v);
}

TEST(CylinderKernel, RaysAlongTheAxisPassBy) {
  for (const float x : {0.0f, 0.5f, 1.0f, 2.0f})
    EXPECT_FALSE(CylinderShape::intersect({x, 0.0f, -1.0f}, {0.0f, 0.0f, 1.0f}, kFar).hit.v) << x;
}

TEST(CylinderKernel, IsOpenAtItsEnds) {
  // In through the open end at z = 1, out through the wall; and all the way through both ends.
  const LocalHit wall = CylinderShape::intersect({0.0f, 0.0f, 2.0f}, {1.0f, 0.0f, -1.5f}, kFar);
  EXPECT_TRUE(wall.hit.v);
  EXPECT_FLOAT_EQ(wall.t.v, 1);
  EXPECT_FALSE(CylinderShape::intersect({0.0f, 0.0f, 2.0f}, {0.25f, 0.0f, -1.0f}, kFar).hit.v);
}

TEST(CylinderKernel, PointsOffTheSurfaceByAFewUlpsDoNotMeetIt) {
  // What spawned rays rely on: 8 ulps of the radius keep rays outwards, even grazing ones, off the surface, and rays
  // inwards from the wall that they start at.
  constexpr double kOff = 8 * 0x1p-24;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int early = 0;
  for (int i = 0; i < 400000; ++i) {
    const double phi = std::numbers::pi * unit(random), z = 0.5 + 0.49 * unit(random);
    const glm::dvec3 n(std::cos(phi), std::sin(phi), 0), tangent(-n.y, n.x, 0.1 * unit(random));
    glm::dvec3 d(unit(random), unit(random), unit(random));
    if (i % 2 == 0) d = tangent + 1e-3 * unit(random) * n;
    if (glm::dot(d, n) < 0) d -= 2 * glm::dot(d, n) * n;
    const glm::dvec3 foot = n + glm::dvec3(0, 0, z);
    early += CylinderShape::intersect(to_lanes(foot + kOff * n), to_lanes(d), kFar).hit.v ? 1 : 0;
    const double chord = 2 * glm::dot(d, n) / (d.x * d.x + d.y * d.y);
    const LocalHit inside = CylinderShape::intersect(to_lanes(foot - kOff * n), to_lanes(-d), kFar);
    early += inside.hit.v && inside.t.v < chord / 2 ? 1 : 0;
  }
  EXPECT_EQ(early, 0);
}

TEST(CylinderKernel, IsHitPreciselyFromAfar) {
  // 10,000 radii away the textbook's discriminant is off by whole radii.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-0.9, 0.9);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 target(0, unit(random), 0.5);
    const Vec3f o = to_lanes({10000, 300, 0.5}), d = to_lanes(glm::normalize(target - to_dvec(o)));
    const double expected = reference(CylinderShape{}, to_dvec(o), to_dvec(d));
    const LocalHit hit = CylinderShape::intersect(o, d, kFar);
    ASSERT_TRUE(hit.hit.v);
    EXPECT_NEAR(hit.t.v, expected, 0.004);  // two ulps of the distance
  }
}

}  // namespace
}  // namespace norrsken::isa_host
