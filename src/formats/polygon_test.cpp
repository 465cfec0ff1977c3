#include "formats/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace norrsken {
namespace {

using Point = PolygonCutter::Point;
using Triangle = PolygonCutter::Triangle;
using Points = std::vector<Point>;

/// The triangles of a polygon, of a fan too.
std::vector<Triangle> triangles_of(const Points& points) {
  PolygonCutter cutter;
  const auto cut = cutter.cut(points);
  EXPECT_FALSE(cutter.too_intricate);
  std::vector<Triangle> triangles(cut.begin(), cut.end());
  for (std::uint32_t i = 2; cut.empty() && i < points.size(); ++i) triangles.push_back({0, i - 1, i});
  return triangles;
}

/// Twice the area of a triangle in the plane z = 0, negative if it is turned over.
double area2(const Points& p, const Triangle& t) {
  const auto &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
  return (double{b[0]} - double{a[0]}) * (double{c[1]} - double{a[1]}) -
         (double{b[1]} - double{a[1]}) * (double{c[0]} - double{a[0]});
}

/// A simple polygon that runs counter-clockwise is covered once: no triangle is turned over, and their areas add up to
/// its own.
void expect_covered(const Points& points) {
  const auto triangles = triangles_of(points);
  ASSERT_EQ(triangles.size(), points.size() - 2);
  double sum = 0, shoelace = 0;
  int turned_over = 0;
  for (const Triangle& t : triangles) {
    turned_over += area2(points, t) < 0 ? 1 : 0;
    sum += area2(points, t);
  }
  EXPECT_EQ(turned_over, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point &a = points[i], &b = points[(i + 1) % points.size()];
    shoelace += double{a[0]} * double{b[1]} - double{a[1]} * double{b[0]};
  }
  EXPECT_NEAR(sum, shoelace, 1e-9 * shoelace);
}

/// The polygon begun at each of its corners.
void expect_covered_from_everywhere(Points points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    SCOPED_TRACE(i);
    expect_covered(points);
    std::rotate(points.begin(), points.begin() + 1, points.end());
  }
}

const Points kL = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};

TEST(Polygon, ConvexOnesAreFans) {
  PolygonCutter cutter;
  EXPECT_TRUE(cutter.cut(Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}).empty());
  EXPECT_TRUE(cutter.cut(Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).empty());
  Points circle;
  for (int i = 0; i < 1000; ++i) {
    const double angle = i * std::numbers::pi / 500;
    circle.push_back({static_cast<float>(std::cos(angle)), 7, static_cast<float>(std::sin(angle))});
  }
  EXPECT_TRUE(cutter.cut(circle).empty());
  // Not flat, but from neither side of a fan's triangles is it seen otherwise.
  EXPECT_TRUE(cutter.cut(Points{{0, 0, 0}, {1, 0, 0.5f}, {1, 1, 0}, {0, 1, 0.5f}}).empty());
}

TEST(Polygon, ConcaveOnesAreCoveredOnce) {
  expect_covered_from_everywhere(kL);
  expect_covered_from_everywhere({{0, 0, 0}, {1, 3, 0}, {0, 1, 0}, {-1, 3, 0}});  // arrowhead
  // Two arms around a hole, joined to the outside by a slit.
  expect_covered_from_everywhere(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
  // Two squares that touch in a corner.
  expect_covered_from_everywhere(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 0}, {0, 1, 0}});
}

TEST(Polygon, TheSideThatItsCornersTurnToIsItsFront) {
  Points from_behind = kL;
  std::ranges::reverse(from_behind);
  double sum = 0;
  for (const Triangle& t : triangles_of(from_behind)) {
    EXPECT_LE(area2(from_behind, t), 0);
    sum += area2(from_behind, t);
  }
  EXPECT_EQ(sum, -10);
}

TEST(Polygon, CornersOnOneLineAndTwiceInARow) {
  expect_covered_from_everywhere(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  expect_covered_from_everywhere(
      {{0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  // A spike: there and back.
  expect_covered_from_everywhere(
      {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {9, 1, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  // A corner in the middle of a square's side is a corner of triangles, not lost in a fan.
  const auto triangles = triangles_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  for (const Triangle& t : triangles) EXPECT_NE(t, (Triangle{0, 1, 2}));
}

TEST(Polygon, AnyPlaneAndScale) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const double scale : {1e-12, 1.0, 1e9}) {
    for (int i = 0; i < 50; ++i) {
      // An L between two random directions, far from the origin in their plane.
      double u[3], v[3];
      for (int k = 0; k < 3; ++k) u[k] = normal(random), v[k] = normal(random);
      Points points = kL;
      for (Point& p : points) {
        const double x = double{p[0]} + 2, y = double{p[1]} - 5;
        for (std::size_t k = 0; k < 3; ++k) p[k] = static_cast<float>(scale * (x * u[k] + y * v[k]));
      }
      PolygonCutter cutter;
      std::rotate(points.begin(), points.begin() + i % 6, points.end());
      const auto cut = cutter.cut(points);
      // Areas in the corners' own coordinates.
      Points flat = kL;
      std::rotate(flat.begin(), flat.begin() + i % 6, flat.end());
      std::vector<Triangle> triangles(cut.begin(), cut.end());
      for (std::uint32_t k = 2; cut.empty() && k < 6; ++k) triangles.push_back({0, k - 1, k});
      double sum = 0;
      for (const Triangle& t : triangles) {
        EXPECT_GE(area2(flat, t), 0);
        sum += area2(flat, t);
      }
      EXPECT_EQ(sum, 10);
    }
  }
}

TEST(Polygon, AFoldedQuadIsCutAlongTheFold) {
  // Seen along its normal it is an arrowhead whose notch is the second corner.
  const Points points = {{0, 0, 0}, {1, 0.2f, 0.3f}, {2, 0, 0}, {1, 3, 0}};
  const auto triangles = triangles_of(points);
  ASSERT_EQ(triangles.size(), 2u);
  for (const Triangle& t : triangles) {
    EXPECT_GT(area2(points, t), 0);
    EXPECT_TRUE(std::ranges::count(t, 1u) == 1 && std::ranges::count(t, 3u) == 1)
        << "the diagonal goes through the notch";
  }
}

/// A star with so many corners, each second of which is near the centre.
Points star(int corners, double inner, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(0.9, 1.0);
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = noise(random) * (i % 2 == 0 ? 1 : inner);
    points.push_back({static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)), 0});
  }
  return points;
}

/// A circle whose radius wanders.
Points coast(int corners) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Points points;
  const double step = 2 * std::numbers::pi / corners;
  double radius = 1;
  for (int i = 0; i < corners; ++i) {
    radius += 2 * step * normal(random) - (radius - 1) * 1e-3;
    points.push_back(
        {static_cast<float>(radius * std::cos(step * i)), static_cast<float>(radius * std::sin(step * i)), 0});
  }
  return points;
}

/// A band that winds around itself.
Points spiral(int corners) {
  Points points;
  const int half = corners / 2;
  const auto at = [&](int i, double offset) {
    const double angle = 0.05 * i, radius = 0.1 * angle + offset;
    return Point{static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)), 0};
  };
  for (int i = 0; i < half; ++i) points.push_back(at(i, 1.3));
  for (int i = half; i-- > 0;) points.push_back(at(i, 1.0));
  return points;
}

Points comb(int teeth) {
  Points points{{0, -1, 0}, {static_cast<float>(2 * teeth), -1, 0}};
  for (int i = teeth; i-- > 0;) {
    points.push_back({static_cast<float>(2 * i + 1), 100, 0});
    points.push_back({static_cast<float>(2 * i), 0, 0});
  }
  return points;
}

TEST(Polygon, RandomSimpleOnesAreCoveredOnce) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    expect_covered(star(5 + static_cast<int>(seed) % 60, 0.2, seed));
  }
  expect_covered(spiral(2000));
  expect_covered(comb(1000));
}

TEST(Polygon, ManyCornersTakeSecondsNotHours) {
  for (const Points& points : {star(100000, 0.5, 1), coast(200000), spiral(10000), comb(4000)}) expect_covered(points);
}

/// Random corners: sides that cross each other all over.
TEST(Polygon, OnesThatCrossThemselvesGetTrianglesOfTheirCorners) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coordinate(0, 4);  // many on one line and at one place
    Points points(4 + seed % 30);
    for (Point& p : points) {
      for (float& x : p) x = static_cast<float>(coordinate(random));
    }
    PolygonCutter cutter;
    const auto cut = cutter.cut(points);
    if (cut.empty()) continue;
    EXPECT_EQ(cut.size(), points.size() - 2);
    for (const Triangle& t : cut) EXPECT_EQ((std::set<std::uint32_t>(t.begin(), t.end()).size()), 3u);
  }
  // A bow tie: one half turns the other way.
  EXPECT_EQ(triangles_of({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 3, 0}}).size(), 2u);
}

TEST(Polygon, WhatTakesTooLongStaysAFan) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(0, 1);
  Points points(20000);
  for (Point& p : points) p = {coordinate(random), coordinate(random), 0};
  PolygonCutter cutter;
  EXPECT_TRUE(cutter.cut(points).empty());
  EXPECT_TRUE(cutter.too_intricate);
}

TEST(Polygon, WithoutAPlaneItStaysAFan) {
  PolygonCutter cutter;
  EXPECT_TRUE(cutter.cut(Points{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).empty());
  EXPECT_TRUE(cutter.cut(Points(5)).empty());
  const float nan = std::nanf("");
  EXPECT_TRUE(cutter.cut(Points{{0, 0, 0}, {1, nan, 0}, {1, 1, 0}, {0, 1, 0}}).empty());
  EXPECT_TRUE(cutter.cut(Points{}).empty());
  EXPECT_FALSE(cutter.too_intricate);
}

}  // namespace
}  // namespace norrsken
