// The kernel's surface points, one lane at a time, against the definitions in double precision.
#include "shape/sdfgrid.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <random>
#include <vector>

namespace norrsken::isa_host {
namespace {

glm::dvec3 to_dvec(const Vec3f& v) { return {v.x.v, v.y.v, v.z.v}; }
Vec3f to_lanes(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A grid's values, and the surface point that the kernel makes of a place.
struct Grid {
  glm::ivec3 size;
  std::vector<float> values;

  Grid(const glm::ivec3& n, const std::function<double(const glm::dvec3&)>& f) : size(n) {
    for (int z = 0; z < n.z; ++z) {
      for (int y = 0; y < n.y; ++y) {
        for (int x = 0; x < n.x; ++x) values.push_back(static_cast<float>(f(glm::dvec3(x, y, z) / glm::dvec3(n - 1))));
      }
    }
  }

  double at(int x, int y, int z) const { return values[static_cast<std::size_t>((z * size.y + y) * size.x + x)]; }
  double at(const glm::ivec3& i) const { return at(i.x, i.y, i.z); }

  LocalSurface surface_at(const glm::dvec3& p, bool smooth) const {
    std::vector<float> table = {0, 0};  // somebody else's
    for (const int n : {size.x, size.y, size.z, smooth ? 1 : 0})
      table.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(n)));
    table.insert(table.end(), values.begin(), values.end());
    return SdfGridShape::surface_at({table.data(), UInt(2u), UInt(0u), {true}}, to_lanes(p));
  }

  glm::ivec3 voxel_of(const glm::dvec3& p) const {
    return glm::clamp(glm::ivec3(glm::floor(p * glm::dvec3(size - 1))), glm::ivec3(0), size - 2);
  }
  /// Interpolates in the voxel that a point is in.
  double value(const glm::dvec3& p) const {
    const glm::ivec3 voxel = voxel_of(p);
    const glm::dvec3 w = p * glm::dvec3(size - 1) - glm::dvec3(voxel);
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const glm::ivec3 corner(i & 1, (i >> 1) & 1, i >> 2);
      double weight = 1;
      for (int a = 0; a < 3; ++a) weight *= corner[a] != 0 ? w[a] : 1 - w[a];
      sum += weight * at(voxel + corner);
    }
    return sum;
  }
  /// A voxel's gradient: between its faces across each axis, at the place of `p` along the other two.
  glm::dvec3 gradient(const glm::ivec3& voxel, const glm::dvec3& p) const {
    glm::dvec3 g;
    for (int a = 0; a < 3; ++a) {
      const double voxels = size[a] - 1;
      glm::dvec3 low = p, high = p;
      low[a] = voxel[a] / voxels, high[a] = (voxel[a] + 1) / voxels;
      g[a] = (value(high) - value(low)) * voxels;
    }
    return g;
  }
  glm::dvec3 blended_normal(const glm::dvec3& p) const {
    const glm::dvec3 at = p * glm::dvec3(size - 1);
    const glm::ivec3 first = glm::ivec3(glm::round(at)) - 1;
    glm::dvec3 weight = at - glm::dvec3(first) - 0.5;
    for (int a = 0; a < 3; ++a) {
      if (first[a] < 0) weight[a] = 1;
      if (first[a] + 1 > size[a] - 2) weight[a] = 0;
    }
    glm::dvec3 sum(0);
    for (int i = 0; i < 8; ++i) {
      const glm::ivec3 corner(i & 1, (i >> 1) & 1, i >> 2);
      double w = 1;
      for (int a = 0; a < 3; ++a) w *= corner[a] != 0 ? weight[a] : 1 - weight[a];
      if (w > 0) sum += w * glm::normalize(gradient(first + corner, p));
    }
    return glm::normalize(sum);
  }
};

Grid random_grid(const glm::ivec3& size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return {size, [&](const glm::dvec3&) { return normal(random); }};
}

glm::dvec3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  return {unit(random), unit(random), unit(random)};
}

TEST(SdfGrid, PlanesAreExact) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(1, -2, 3));
  const Grid grid({4, 5, 6}, [&](const glm::dvec3& p) { return 7 * (glm::dot(n, p) - 0.4); });
  std::mt19937 random(1);
  int points = 0;
  for (int i = 0; i < 1000; ++i) {
    // Up to a tenth of a voxel off.
    const glm::dvec3 p = random_point(random), foot = p - n * (glm::dot(n, p) - 0.4), near = foot + n * 0.02 * p.x;
    if (glm::any(glm::lessThan(foot, glm::dvec3(0.02))) || glm::any(glm::greaterThan(foot, glm::dvec3(0.98)))) continue;
    ++points;
    for (const bool smooth : {false, true}) {
      const LocalSurface s = grid.surface_at(near, smooth);
      EXPECT_LT(glm::length(to_dvec(s.position) - foot), 1e-6);
      EXPECT_LT(glm::length(to_dvec(s.normal) - n), 3e-6);
      EXPECT_LT(glm::length(to_dvec(s.shading) - n), 3e-6);
    }
  }
  EXPECT_GT(points, 200);
}

TEST(SdfGrid, NormalsAreGradients) {
  const Grid grid = random_grid({5, 3, 4}, 2);
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p = to_dvec(to_lanes(random_point(random)));
    const glm::dvec3 g = grid.gradient(grid.voxel_of(p), p);
    const LocalSurface analytic = grid.surface_at(p, false), smooth = grid.surface_at(p, true);
    EXPECT_LT(glm::length(to_dvec(analytic.normal) - glm::normalize(g)), 1e-4 / glm::length(g)) << i;
    EXPECT_EQ(to_dvec(smooth.normal), to_dvec(analytic.normal));
    EXPECT_EQ(to_dvec(analytic.shading), to_dvec(analytic.normal));
  }
}

TEST(SdfGrid, ShadingNormalsBlendTheEightVoxelsAround) {
  const Grid grid = random_grid({5, 3, 2}, 4);
  std::mt19937 random(5);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 p = to_dvec(to_lanes(random_point(random)));
    const glm::dvec3 expected = grid.blended_normal(p);
    EXPECT_LT(glm::length(to_dvec(grid.surface_at(p, true).shading) - expected), 2e-4) << i;
  }
}

TEST(SdfGrid, ShadingNormalsHaveNoSteps) {
  const Grid grid = random_grid({4, 4, 4}, 6);
  std::mt19937 random(7);
  int steps = 0;
  for (int i = 0; i < 2000; ++i) {
    // On both sides of a face between voxels, and of the middle of one.
    glm::dvec3 p = random_point(random);
    const int a = i % 3;
    p[a] = (i % 5 + 1) / 6.0;
    glm::dvec3 q = p;
    p[a] -= 1e-6, q[a] += 1e-6;
    EXPECT_LT(glm::length(to_dvec(grid.surface_at(p, true).shading) - to_dvec(grid.surface_at(q, true).shading)), 1e-3);
    steps += glm::length(to_dvec(grid.surface_at(p, false).shading) - to_dvec(grid.surface_at(q, false).shading)) > 0.1;
  }
  EXPECT_GT(steps, 100);  // which the gradients have
}

TEST(SdfGrid, PointsMoveOntoTheSurface) {
  const Grid grid({17, 17, 17}, [](const glm::dvec3& p) { return glm::length(p - 0.5) - 0.35; });
  std::mt19937 random(8);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 outwards = glm::normalize(random_point(random) - 0.5);
    double inside = 0.3, outside = 0.4;
    for (int k = 0; k < 60; ++k) {
      const double middle = (inside + outside) / 2;
      (grid.value(0.5 + middle * outwards) < 0 ? inside : outside) = middle;
    }
    for (const double off : {1e-3, -1e-4, 1e-5}) {
      const glm::dvec3 p = 0.5 + (inside + off) * outwards, moved = to_dvec(grid.surface_at(p, true).position);
      // The gradient may be that of the neighbour, which is another by up to a voxel over the radius.
      EXPECT_LT(std::abs(grid.value(moved)), 0.2 * std::abs(off) + 3e-7) << i;
      EXPECT_LT(glm::length(moved - p), 1.2 * std::abs(off) + 3e-7) << i;
    }
  }
}

TEST(SdfGrid, DegenerateValuesStillMakeNormals) {
  std::mt19937 random(9);
  for (const double factor : {0.0, 1e-42, 1e-38, 1e-30, 1.0}) {
    // A voxel of all but nothing beside one of ordinary values.
    const Grid grid({3, 2, 2}, [&](const glm::dvec3& p) { return p.x > 0.75 ? 1 : factor * (p.z - 0.5); });
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 p = random_point(random);
      const LocalSurface s = grid.surface_at(p, true);
      ASSERT_NEAR(glm::length(to_dvec(s.normal)), 1, 1e-6) << factor;
      ASSERT_NEAR(glm::length(to_dvec(s.shading)), 1, 1e-6) << factor;
      ASSERT_LT(glm::length(to_dvec(s.position) - p), 0.3) << factor;
      if (factor == 1e-30 && p.x < 0.5) {
        EXPECT_LT(glm::length(to_dvec(s.normal) - glm::dvec3(0, 0, 1)), 1e-5);
      }
    }
  }
}

TEST(SdfGrid, HasNeitherTextureCoordinatesNorTangents) {
  const LocalSurface s = random_grid({2, 2, 2}, 10).surface_at({0.2, 0.3, 0.4}, true);
  EXPECT_EQ(s.uv.x.v, 0);
  EXPECT_EQ(s.uv.y.v, 0);
  EXPECT_EQ(to_dvec(s.dp_du), glm::dvec3(0));
  EXPECT_EQ(to_dvec(s.dp_dv), glm::dvec3(0));
}

}  // namespace
}  // namespace norrsken::isa_host
