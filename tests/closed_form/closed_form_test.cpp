// The closed forms against each other and against plain quadrature.
#include "tests/closed_form/closed_form.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace norrsken::closed_form {
namespace {

using std::numbers::pi;

TEST(ClosedForm, PointLightFollowsTheInverseSquareAndTheCosine) {
  const Vec up{0, 0, 1};
  EXPECT_DOUBLE_EQ(point_light_irradiance(12, {0, 0, 2}, {0, 0, 0}, up), 3);
  // 3-4-5 triangle: cosine 4/5, distance 5
  EXPECT_DOUBLE_EQ(point_light_irradiance(125, {3, 0, 4}, {0, 0, 0}, up), 4);
  EXPECT_EQ(point_light_irradiance(125, {3, 0, -4}, {0, 0, 0}, up), 0);
}

TEST(ClosedForm, RectangleAboveItsCornerHasTheTextbookFormFactor) {
  // Parallel rectangle a x b at height c above a point under one corner (Howell, catalogue of configuration factors,
  // B-3): F = 1/(2 pi) (A/sqrt(1+A^2) atan(B/sqrt(1+A^2)) + B/sqrt(1+B^2) atan(A/sqrt(1+B^2))), A = a/c, B = b/c.
  for (const auto& [a, b, c] : std::array<std::array<double, 3>, 3>{{{1, 1, 1}, {2, 0.5, 3}, {10, 7, 0.2}}}) {
    const double wide = a / c, deep = b / c;
    const double ra = std::sqrt(1 + wide * wide), rb = std::sqrt(1 + deep * deep);
    const double factor = (wide / ra * std::atan(deep / ra) + deep / rb * std::atan(wide / rb)) / (2 * pi);
    const std::array<Vec, 4> rectangle = {{{0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}}};
    EXPECT_NEAR(polygon_irradiance(5, rectangle, {0, 0, 0}, {0, 0, 1}), 5 * pi * factor, 1e-12);
  }
}

TEST(ClosedForm, PolygonIrradianceEqualsQuadratureForATiltedReceiver) {
  const Vec origin{-0.3, 0.4, 1.1}, side_a{1.2, 0.1, 0.2}, side_b{-0.1, 0.9, 0.3};
  const std::array<Vec, 4> quad = {origin, origin + side_a, origin + side_a + side_b, origin + side_b};
  const Vec normal = normalize(Vec{0.1, -0.2, 1});
  const Vec area = cross(side_a, side_b);
  constexpr int kSteps = 1000;  // midpoint rule, error of order 1 / kSteps^2
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Vec p = origin + (i + 0.5) / kSteps * side_a + (j + 0.5) / kSteps * side_b;
      const double d2 = dot(p, p);
      sum += dot(p, normal) * std::abs(dot(p, area)) / (d2 * d2);
    }
  }
  EXPECT_NEAR(polygon_irradiance(3, quad, {0, 0, 0}, normal) / (3 * sum / (kSteps * kSteps)), 1, 1e-6);
}

TEST(ClosedForm, PolygonFillingTheHemisphereGivesPiTimesItsRadiance) {
  const std::array<Vec, 4> sky = {{{-1e6, -1e6, 1}, {1e6, -1e6, 1}, {1e6, 1e6, 1}, {-1e6, 1e6, 1}}};
  EXPECT_NEAR(polygon_irradiance(2, sky, {0, 0, 0}, {0, 0, 1}), 2 * pi, 1e-5);
}

TEST(ClosedForm, SphereEqualsQuadratureOverItsCone) {
  // Directions of the cone around `axis`: height w = 1 - k (1 - cos a), azimuth phi.
  const Vec centre{0.7, -0.4, 2.5}, normal = normalize(Vec{0.2, 0.1, 1});
  const double radius = 1.1;
  const Vec axis = normalize(centre), u = normalize(cross(axis, {0, 1, 0})), v = cross(axis, u);
  const double cap = 1 - std::sqrt(1 - radius * radius / dot(centre, centre));
  constexpr int kSteps = 500;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double w = 1 - cap * (i + 0.5) / kSteps, phi = 2 * pi * (j + 0.5) / kSteps;
      const double r = std::sqrt(1 - w * w);
      sum += dot(normal, w * axis + r * std::cos(phi) * u + r * std::sin(phi) * v);
    }
  }
  const double solid_angle = 2 * pi * cap;
  EXPECT_NEAR(sphere_irradiance(3, centre, radius, {0, 0, 0}, normal) / (3 * solid_angle * sum / (kSteps * kSteps)), 1,
              1e-6);
}

TEST(ClosedForm, UniformRoomIsAGeometricSeries) {
  EXPECT_DOUBLE_EQ(uniform_room_radiance(2, 0.5, 0), 2);
  EXPECT_DOUBLE_EQ(uniform_room_radiance(2, 0.5, 1), 3);
  EXPECT_DOUBLE_EQ(uniform_room_radiance(2, 0.5, 3), 3.75);
  EXPECT_NEAR(uniform_room_radiance(1, 0.9, 400), 10, 1e-12);
}

}  // namespace
}  // namespace norrsken::closed_form
