// Warps against their densities, and the small functions they stand on.
#include "math/warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "math/frame.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

using statistics::Direction;
using statistics::Point;
using statistics::Random;
using statistics::StatisticalTest;

Vec2f square(Random& random) {
  const float x = random(), y = random();
  return {Float(x), Float(y)};
}
Point point(const Vec2f& v) { return {double{v.x.v}, double{v.y.v}}; }

/// What maps the unit square to directions, against what says how densely.
template <class Warp>
statistics::Sampling directions(const Warp& warp, const std::function<double(const Direction&)>& pdf_sa) {
  return statistics::sampling_of_directions(
      [warp](Random& random) -> std::optional<Direction> {
        const Vec3f w = warp(square(random));
        EXPECT_NEAR(double(dot(w, w).v), 1, 1e-5);
        return Direction{double{w.x.v}, double{w.y.v}, double{w.z.v}};
      },
      pdf_sa);
}

TEST(Warp, DiskPreservesArea) {
  StatisticalTest test;
  // Squared radius and angle are uniform over the disk.
  statistics::EvenCells cells({{0, -0.5}, {1, 0.5}}, 32, 32);
  Random random(1);
  for (int i = 0; i < 1'000'000; ++i) {
    const Point d = point(warp_to_disk(square(random)));
    const double r2 = d[0] * d[0] + d[1] * d[1];
    ASSERT_LE(r2, 1.0 + 1e-6);
    cells.add({r2, std::atan2(d[1], d[0]) / (2 * M_PI)});
  }
  EXPECT_TRUE(test.chi_square(cells.cells(), {"squared radius", "angle in turns"}, "warp_to_disk"));
}

TEST(Warp, CosineHemisphereFollowsItsDensity) {
  StatisticalTest test;
  EXPECT_TRUE(test.follows_density(
      directions(warp_to_cosine_hemisphere,
                 [](const Direction& d) { return double{cosine_hemisphere_pdf_sa(Float(float(d[2]))).v}; }),
      "warp_to_cosine_hemisphere"));
}

TEST(Warp, SphereIsUniform) {
  StatisticalTest test;
  EXPECT_TRUE(test.follows_density(directions(warp_to_sphere, [](const Direction&) { return 1 / (4 * M_PI); }),
                                   "warp_to_sphere"));
}

TEST(Warp, TriangleIsUniform) {
  StatisticalTest test;
  const statistics::Sampling sampling{
      {{0, 0}, {1, 1}},
      {"b1", "b2"},
      [](Random& random) { return std::optional(point(warp_to_triangle(square(random)))); },
      [](const Point& b) { return b[0] + b[1] < 1 ? 2.0 : 0.0; }};
  EXPECT_TRUE(test.follows_density(sampling, "warp_to_triangle"));
}

/// Uniform in 1 - cos, up to `h`, and in the angle; the cone's edge is sharp and its own coordinates know where it is.
TEST(Warp, ConeIsUniformOverItsSolidAngle) {
  StatisticalTest test;
  for (const float h : {1e-6f, 0.01f, 0.5f, 1.0f}) {
    statistics::EvenCells cells({{0, -0.5}, {1, 0.5}}, 32, 32);
    statistics::Mean height;
    Random random(2);
    for (int i = 0; i < 1'000'000; ++i) {
      const Vec3f w = warp_to_cone(square(random), Float(h));
      const double x{w.x.v}, y{w.y.v}, sin2 = x * x + y * y;
      const double share = sin2 / (1 + std::sqrt(std::max(0.0, 1 - sin2))) / double{h};  // without cancellation
      ASSERT_LT(share, 1 + 1e-5);
      cells.add({share, std::atan2(y, x) / (2 * M_PI)});
      height.add(share);
    }
    const std::string what = "warp_to_cone, 1 - cos " + std::to_string(h);
    EXPECT_TRUE(test.chi_square(cells.cells(), {"1 - cos over that of the edge", "angle in turns"}, what));
    EXPECT_TRUE(test.agree(height.estimate(), 0.5, what + ", mean height"));
    EXPECT_NEAR(double{cone_pdf_sa(Float(h)).v} * 2 * M_PI * double{h}, 1.0, 1e-5);
  }
}

TEST(Trig, SinCosOfTurns) {
  for (int i = 0; i <= 100'000; ++i) {
    const float u = static_cast<float>(i) / 100'000;
    const SinCos q = sin_cos_turns(Float(u));
    ASSERT_NEAR(double(q.sin.v), std::sin(2 * M_PI * double(u)), 4e-7) << u;
    ASSERT_NEAR(double(q.cos.v), std::cos(2 * M_PI * double(u)), 4e-7) << u;
  }
}

TEST(Frame, IsOrthonormalAroundEveryNormal) {
  for (int i = -20; i <= 20; ++i) {
    for (int k = 0; k < 40; ++k) {
      const double z = i / 20.0, r = std::sqrt(1 - z * z), phi = k * M_PI / 20;
      const Vec3f n{float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)};
      const Frame f = make_frame(n);
      EXPECT_NEAR(double(dot(f.s, f.s).v), 1, 1e-5);
      EXPECT_NEAR(double(dot(f.t, f.t).v), 1, 1e-5);
      EXPECT_NEAR(double(dot(f.s, f.t).v), 0, 1e-5);
      EXPECT_NEAR(double(dot(f.s, n).v), 0, 1e-5);
      EXPECT_NEAR(double(dot(f.t, n).v), 0, 1e-5);
      const Vec3f right = cross(f.s, f.t);
      EXPECT_NEAR(double(dot(right, n).v), 1, 1e-5);
      const Vec3f w{Float(0.36f), Float(0.48f), Float(-0.8f)}, back = f.to_world(f.to_local(w));
      EXPECT_NEAR(double(dot(back, w).v), 1, 1e-5);
    }
  }
}

}  // namespace
}  // namespace norrsken::isa_host
