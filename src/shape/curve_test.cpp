// The kernels of the curves, one lane at a time, against their parameterisations in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "shape/bsplinecurve.h"
#include "shape/linearcurve.h"

namespace norrsken::isa_host {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

glm::dvec3 to_dvec(const Vec3f& v) { return {v.x.v, v.y.v, v.z.v}; }
Vec3f to_lanes(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

struct ControlPoint {
  std::array<float, 4> values;
  glm::dvec3 p() const { return {values[0], values[1], values[2]}; }
  double r() const { return double{values[3]}; }
};
using Segment = std::vector<ControlPoint>;

/// Centre, radius and their derivatives along a segment.
struct Along {
  glm::dvec3 c, dc, ddc;
  double r, dr;
};
Along along(LinearCurveShape, const Segment& s, double t) {
  const glm::dvec3 d = s[1].p() - s[0].p();
  return {s[0].p() + t * d, d, {}, s[0].r() + t * (s[1].r() - s[0].r()), s[1].r() - s[0].r()};
}
Along along(BsplineCurveShape, const Segment& s, double t) {
  const double w[4] = {(1 - t) * (1 - t) * (1 - t) / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                       (1 + 3 * t + 3 * t * t - 3 * t * t * t) / 6, t * t * t / 6};
  const double dw[4] = {-(1 - t) * (1 - t) / 2, (3 * t * t - 4 * t) / 2, (1 + 2 * t - 3 * t * t) / 2, t * t / 2};
  const double ddw[4] = {1 - t, 3 * t - 2, 1 - 3 * t, t};
  Along a{{}, {}, {}, 0, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    a.c += w[k] * s[k].p(), a.dc += dw[k] * s[k].p(), a.ddc += ddw[k] * s[k].p();
    a.r += w[k] * s[k].r(), a.dr += dw[k] * s[k].r();
  }
  return a;
}

/// The direction away from the curve, across it, at the angle u.
glm::dvec3 across(const glm::dvec3& tangent, double u) {
  const glm::dvec3 t = glm::normalize(tangent), z(0, 0, 1);
  const glm::dvec3 quarter = glm::normalize(z - t * t.z), start = glm::cross(quarter, t);
  return std::cos(kTurn * u) * start + std::sin(kTurn * u) * quarter;
}

/// The surface's point at (u, t): of the ball that touches it there, or of the circle.
glm::dvec3 at(LinearCurveShape shape, const Segment& s, double u, double t) {
  const Along a = along(shape, s, t);
  const double length = glm::length(a.dc), sine = -a.dr / length;
  return a.c + a.r * (sine * a.dc / length + std::sqrt(1 - sine * sine) * across(a.dc, u));
}
glm::dvec3 at(BsplineCurveShape shape, const Segment& s, double u, double t) {
  const Along a = along(shape, s, t);
  return a.c + a.r * across(a.dc, u);
}

/// A segment whose radius stays below that of its curvature: `size` about the origin and around `place`.
template <class Shape>
Segment random_segment(std::mt19937& random, const glm::dvec3& place, double size) {
  std::uniform_real_distribution<double> unit(-1, 1);
  constexpr std::size_t kPoints = std::is_same_v<Shape, LinearCurveShape> ? 2 : 4;
  Segment segment(kPoints);
  const glm::dvec3 step(unit(random), unit(random), unit(random));
  for (std::size_t k = 0; k < kPoints; ++k) {
    const glm::dvec3 wiggle(unit(random), unit(random), unit(random));
    const glm::dvec3 p = place + size * (static_cast<double>(k) * (glm::normalize(step)) + 0.4 * wiggle);
    const double r = size * (0.08 + 0.06 * unit(random));
    segment[k].values = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                         static_cast<float>(r)};
  }
  return segment;
}

/// As the host files write it: the segment is number `element` of `count`, which all have the same control points.
std::vector<float> table_of(const Segment& segment, std::uint32_t count) {
  std::vector<float> table{7, 7, 7, std::bit_cast<float>(count)};
  for (std::uint32_t i = 0; i < count; ++i) table.push_back(std::bit_cast<float>(1u));
  for (int k = 0; k < 4; ++k) table.push_back(1e9f);  // a control point of something else
  for (const ControlPoint& p : segment) table.insert(table.end(), p.values.begin(), p.values.end());
  return table;
}

constexpr std::uint32_t kCount = 5, kElement = 3;

template <class Shape>
LocalSurface surface_at(const Segment& segment, const glm::dvec3& p) {
  const std::vector<float> table = table_of(segment, kCount);
  return Shape::surface_at(ElementReader{table.data(), UInt(3u), UInt(kElement), Mask{true}}, to_lanes(p));
}

template <class Shape>
class Curve : public ::testing::Test {};
using Shapes = ::testing::Types<LinearCurveShape, BsplineCurveShape>;
TYPED_TEST_SUITE(Curve, Shapes);

double turns_apart(double a, double b) { return std::abs(std::remainder(a - b, 1.0)); }

TYPED_TEST(Curve, ParameterisationNormalsAndTangentsFit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr double kStep = 1e-6;
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (int i = 0; i < 3000; ++i) {
      const Segment s = random_segment<TypeParam>(random, glm::dvec3(0), size);
      const double u = unit(random), t = 0.001 + 0.998 * unit(random);
      const TypeParam shape;
      const glm::dvec3 p = at(shape, s, u, t);
      const double speed = glm::length(along(shape, s, t).dc) / size;
      if (speed < 0.3 || std::hypot(along(shape, s, t).dc.x, along(shape, s, t).dc.y) < 0.1 * size) continue;
      const LocalSurface found = surface_at<TypeParam>(s, p);
      SCOPED_TRACE(::testing::Message() << "size " << size << ", segment " << i << ", t " << t);
      EXPECT_LT(glm::length(to_dvec(found.position) - p), 2e-6 * size);
      EXPECT_LT(turns_apart(double{found.uv.x.v}, u), 1e-5);
      EXPECT_NEAR(double{found.uv.y.v}, (kElement + t) / kCount, 1e-5);
      const glm::dvec3 du = (at(shape, s, u + kStep, t) - at(shape, s, u - kStep, t)) / (2 * kStep);
      const glm::dvec3 dv = (at(shape, s, u, t + kStep) - at(shape, s, u, t - kStep)) / (2 * kStep) * double{kCount};
      const glm::dvec3 n = glm::normalize(glm::cross(du, dv));
      EXPECT_LT(glm::length(to_dvec(found.normal) - n), 1e-4);
      EXPECT_LT(glm::length(to_dvec(found.shading) - n), 1e-4);
      // Along a cone's generator the point at u and t moves with the ball that touches it: the same as Mitsuba's.
      EXPECT_LT(glm::length(to_dvec(found.dp_dv) - dv), 1e-3 * glm::length(dv));
      EXPECT_GE(found.scale.v, 0.1 * size);
      EXPECT_LE(found.scale.v, 100 * size);
      const double cosine = glm::dot(to_dvec(found.dp_du), du) / (glm::length(du) * glm::length(to_dvec(found.dp_du)));
      EXPECT_GT(cosine, 1 - 1e-6);
    }
  }
}

TYPED_TEST(Curve, PointsOffTheSurfaceAreMovedOntoIt) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  // Far from the origin only the rounding of the coordinates themselves is left: half an ulp of each of three.
  for (const double far : {0.0, 100.0}) {
    const double ulp = far == 0 ? 0 : 7e-6;
    for (int i = 0; i < 3000; ++i) {
      const Segment s =
          random_segment<TypeParam>(random, far * glm::dvec3(unit(random), unit(random), unit(random)), 1);
      const double u = unit(random), t = 0.5 + 0.49 * unit(random);
      const glm::dvec3 p = at(TypeParam{}, s, u, t);
      if (glm::length(along(TypeParam{}, s, t).dc) < 0.3) continue;
      const glm::dvec3 off = p + 1e-3 * unit(random) * to_dvec(surface_at<TypeParam>(s, p).normal);
      const LocalSurface found = surface_at<TypeParam>(s, off);
      // How far it is from the surface, by its own coordinates.
      const double t_found = double{found.uv.y.v} * kCount - kElement;
      const Along a = along(TypeParam{}, s, t_found);
      EXPECT_NEAR(glm::distance(to_dvec(found.position), a.c), a.r, 1e-6 + ulp) << i << " " << far;
      EXPECT_LT(glm::distance(to_dvec(found.position), p), 2e-3) << i << " " << far;
    }
  }
}

TEST(LinearCurveKernel, IsRoundAtTheEnds) {
  const Segment s{{{1, 2, 3, 0.5f}}, {{1, 2, 6, 0.25f}}};
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.2, -0.7)), m = glm::normalize(glm::dvec3(0.3, 0.1, 0.7));
  const LocalSurface below = surface_at<LinearCurveShape>(s, s[0].p() + 0.501 * n);
  EXPECT_LT(glm::length(to_dvec(below.normal) - n), 1e-6);
  EXPECT_LT(glm::length(to_dvec(below.position) - s[0].p() - 0.5 * n), 1e-6);
  EXPECT_FLOAT_EQ(below.uv.y.v, 3.0f / 5);
  const LocalSurface above = surface_at<LinearCurveShape>(s, s[1].p() + 0.2501 * m);
  EXPECT_LT(glm::length(to_dvec(above.normal) - m), 1e-6);
  EXPECT_FLOAT_EQ(above.uv.y.v, 4.0f / 5);
}

TEST(LinearCurveKernel, OfTwoBallsOneInsideTheOtherShowsTheLarger) {
  const Segment s{{{0, 0, 0, 0.25f}}, {{0, 0.5f, 0, 1}}};
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.8, 0.1));
  const LocalSurface found = surface_at<LinearCurveShape>(s, s[1].p() + n);
  EXPECT_LT(glm::length(to_dvec(found.normal) - n), 1e-6);
  EXPECT_FLOAT_EQ(found.uv.y.v, 4.0f / 5);
}

TEST(CurveKernel, UprightItsAngleBeginsAtX) {
  const Segment s{{{0, 0, 0, 0.5f}}, {{0, 0, 2, 0.5f}}};
  EXPECT_NEAR(surface_at<LinearCurveShape>(s, {0.5, 0, 1}).uv.x.v, 0, 1e-6);
  EXPECT_NEAR(surface_at<LinearCurveShape>(s, {0, 0.5, 1}).uv.x.v, 0.25, 1e-6);
  EXPECT_NEAR(surface_at<LinearCurveShape>(s, {0, -0.5, 1}).uv.x.v, 0.75, 1e-6);
  const Segment down{{{0, 0, 2, 0.5f}}, {{0, 0, 0, 0.5f}}};
  EXPECT_NEAR(surface_at<LinearCurveShape>(down, {-0.5, 0, 1}).uv.x.v, 0, 1e-6);
}

TEST(BsplineCurveKernel, FindsItsPlaceOnATightBend) {
  // A hairpin that is across many points twice, and once its other arm.
  const Segment s{{{-3, 0, 0, 0.08f}}, {{3, 0, 0, 0.08f}}, {{3, 1, 0, 0.08f}}, {{-3, 1, 0, 0.08f}}};
  for (int i = 0; i <= 40; ++i) {
    for (int k = 0; k < 8; ++k) {
      const double t = i / 40.0, u = k / 8.0;
      const LocalSurface found = surface_at<BsplineCurveShape>(s, at(BsplineCurveShape{}, s, u, t));
      EXPECT_NEAR(double{found.uv.y.v} * kCount - kElement, t, 2e-5) << t << " " << u;
    }
  }
}

TEST(BsplineCurveKernel, BeginsWithoutADirectionWhereControlPointsCoincide) {
  const Segment s{{{0, 0, 0, 0.1f}}, {{0, 0, 0, 0.1f}}, {{0, 0, 0, 0.1f}}, {{6, 0, 0, 0.1f}}};
  const LocalSurface begin = surface_at<BsplineCurveShape>(s, {0, 0.1, 0});
  EXPECT_LT(glm::length(to_dvec(begin.normal) - glm::dvec3(0, 1, 0)), 1e-6);
  const LocalSurface end = surface_at<BsplineCurveShape>(s, {1, 0, -0.1});
  EXPECT_LT(glm::length(to_dvec(end.normal) - glm::dvec3(0, 0, -1)), 1e-5);
  EXPECT_NEAR(double{end.uv.y.v}, 4.0 / 5, 1e-5);
}

TEST(BsplineCurveKernel, MayEndInAPoint) {
  const Segment s{{{0, 0, 0, 0.2f}}, {{1, 0, 0, 0.1f}}, {{2, 0, 0, 0}}, {{3, 0, 0, -0.1f}}};
  const LocalSurface tip = surface_at<BsplineCurveShape>(s, {2, 0, 0});
  EXPECT_TRUE(std::isfinite(tip.normal.x.v) && std::isfinite(tip.uv.x.v) && std::isfinite(tip.dp_dv.x.v));
  EXPECT_NEAR(glm::length(to_dvec(tip.normal)), 1, 1e-5);
  EXPECT_LT(glm::length(to_dvec(tip.position) - glm::dvec3(2, 0, 0)), 1e-6);
}

}  // namespace
}  // namespace norrsken::isa_host
