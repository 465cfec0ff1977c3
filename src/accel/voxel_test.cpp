// One voxel and one ray: closed forms, polynomials by brute force, and neighbours that share a face.
#include "accel/voxel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace norrsken {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

using Values = std::array<double, 8>;

/// The interpolation of values at the corners, as its definition says.
double interpolated(const Values& values, const glm::dvec3& w) {
  double sum = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= ((i >> a) & 1) != 0 ? w[a] : 1 - w[a];
    sum += weight * values[i];
  }
  return sum;
}

template <class Function>
Values sampled(const Function& f) {
  Values values;
  for (std::size_t i = 0; i < 8; ++i) values[i] = f(glm::dvec3(i & 1, (i >> 1) & 1, i >> 2));
  return values;
}

Values random_values(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Values values;
  for (double& v : values) v = static_cast<double>(static_cast<float>(normal(random)));
  return values;
}

glm::dvec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

TEST(Voxel, PlanesAreHitWhereTheyAre) {
  std::mt19937 random(1);
  int hits = 0;
  for (int i = 0; i < 10000; ++i) {
    const glm::dvec3 n = random_vector(random), lower(3, -2, 7);
    const double at = glm::dot(n, glm::dvec3(0.5)) + 0.3 * random_vector(random).x;
    const Voxel voxel{lower, sampled([&](const glm::dvec3& w) { return glm::dot(n, w) - at; })};
    const glm::dvec3 o = lower + 3.0 * random_vector(random);
    const glm::dvec3 d = lower + glm::dvec3(0.5) + 0.4 * random_vector(random) - o;
    const double t = (at - glm::dot(n, o - lower)) / glm::dot(n, d);
    const glm::dvec3 w = o + t * d - lower;
    double outside = -INFINITY;
    for (int a = 0; a < 3; ++a) outside = std::max({outside, -w[a], w[a] - 1});
    if (std::abs(outside) < 1e-9 || std::abs(t) < 1e-9) continue;  // along an edge, or it starts on the surface
    const auto hit = cross_voxel(voxel, o, d, kFar);
    ASSERT_EQ(hit.has_value(), outside <= 0 && t > 0) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_EQ(hit->t, static_cast<float>(t)) << i;
    EXPECT_LT(glm::length(hit->gradient - n), 1e-12) << i;
  }
  EXPECT_GT(hits, 1000);
}

TEST(Voxel, TheFirstOfThreeRootsCounts) {
  // Along the diagonal 8 (s - 1/4) (s - 1/2) (s - 3/4): its Bernstein coefficients, by how many steps a corner is from 0.
  Values values;
  const double bernstein[4] = {-3 / 4.0, 13 / 12.0, -13 / 12.0, 3 / 4.0};
  for (std::size_t i = 0; i < 8; ++i) values[i] = bernstein[(i & 1) + ((i >> 1) & 1) + (i >> 2)];
  const glm::dvec3 d(1);
  const Voxel voxel{{0, 0, 0}, values};
  const auto start = [&](double from) { return cross_voxel(voxel, glm::dvec3(from), d, kFar); };
  ASSERT_TRUE(start(-1));
  EXPECT_FLOAT_EQ(start(-1)->t, 1.25f);
  EXPECT_FLOAT_EQ(start(0.4)->t, 0.1f);
  EXPECT_FLOAT_EQ(start(0.6)->t, 0.15f);
  EXPECT_FALSE(start(0.8));
  // Up to a limit.
  EXPECT_TRUE(cross_voxel(voxel, glm::dvec3(0), d, 0.250001f));
  EXPECT_FALSE(cross_voxel(voxel, glm::dvec3(0), d, 0.249999f));
}

TEST(Voxel, RandomSurfacesAreHitAtTheFirstChangeOfSign) {
  std::mt19937 random(2);
  int hits = 0, grazing = 0;
  for (int i = 0; i < 4000; ++i) {
    const Values values = random_values(random);
    const Voxel voxel{{0, 0, 0}, values};
    // From a face to inside, so that the whole way is in the voxel.
    glm::dvec3 o = glm::abs(random_vector(random)) / 4.0, p = glm::abs(random_vector(random)) / 4.0;
    o = glm::min(o, glm::dvec3(1)), p = glm::min(p, glm::dvec3(1));
    const glm::dvec3 d = p - o;
    const auto f = [&](double t) { return interpolated(values, o + t * d); };
    constexpr int kSteps = 2000;
    double expected = INFINITY;
    for (int k = 0; k < kSteps && expected == INFINITY; ++k) {
      double low = k / double{kSteps}, high = (k + 1.0) / kSteps;
      if ((f(low) < 0) == (f(high) < 0)) continue;
      for (int bisection = 0; bisection < 60; ++bisection) {
        const double middle = (low + high) / 2;
        ((f(middle) < 0) == (f(low) < 0) ? low : high) = middle;
      }
      expected = low;
    }
    const auto hit = cross_voxel(voxel, o, d, 1);
    const float found = hit ? hit->t : INFINITY;
    if (std::abs(found - expected) > 1e-6 * expected && found < expected) {
      // Two crossings closer than a step: between them the sign is another.
      ASSERT_LT(std::abs(f(static_cast<double>(found))), 1e-6) << i;
      ++grazing;
      continue;
    }
    ASSERT_EQ(hit.has_value(), expected < 1) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->t, expected, 1e-6) << i;
    constexpr double kStep = 1e-5;
    for (int a = 0; a < 3; ++a) {
      glm::dvec3 e(0);
      e[a] = kStep;
      const glm::dvec3 at = o + expected * d;
      EXPECT_NEAR(hit->gradient[a], (interpolated(values, at + e) - interpolated(values, at - e)) / (2 * kStep), 1e-6);
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_LT(grazing, 8);
}

TEST(Voxel, NoRaySlipsThroughBetweenNeighbours) {
  // Two voxels that share a face, inside on the one end and outside on the other, with values on the face so small that
  // crossings are as close to it as rounding allows: a ray from end to end meets the surface in one of them.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 40000; ++i) {
    const int axis = i % 3;
    const double tiny = std::ldexp(1.0, -static_cast<int>(random() % 60)), sign = i % 2 == 0 ? 1 : -1;
    Values near = random_values(random), far = random_values(random);
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t across = k ^ (std::size_t{1} << axis);
      if (k < across) {
        near[k] = sign * std::abs(near[k]);
        far[across] = -sign * std::abs(far[across]);
      } else {
        near[k] *= tiny;
        far[across] = near[k];
      }
    }
    const glm::dvec3 lower(5, 6, 7);
    glm::dvec3 upper = lower;
    upper[axis] += 1;
    glm::dvec3 through = lower + 0.1 + 0.8 * glm::dvec3(unit(random), unit(random), unit(random));
    through[axis] = upper[axis];
    glm::dvec3 d = 0.1 * (glm::dvec3(unit(random), unit(random), unit(random)) - 0.5);
    d[axis] = (i % 4 < 2 ? 1 : -1) * (1 + unit(random));
    const glm::dvec3 origin = through - (2 + 1000 * unit(random)) * d;
    ASSERT_TRUE(cross_voxel({lower, near}, origin, d, kFar) || cross_voxel({upper, far}, origin, d, kFar)) << i;
  }
}

TEST(Voxel, SurfacesOnFacesBelongToTheVoxelWithNegativeValues) {
  const Voxel below{{0, 0, 0}, sampled([](const glm::dvec3& w) { return w.z - 1; })};
  const Voxel above{{0, 0, 1}, sampled([](const glm::dvec3& w) { return w.z; })};
  EXPECT_FALSE(cross_voxel(above, {0.3, 0.6, 3}, {0, 0, -1}, kFar));
  EXPECT_FALSE(cross_voxel(above, {0.3, 0.6, -1}, {0, 0, 1}, kFar));
  const auto down = cross_voxel(below, {0.3, 0.6, 3}, {0, 0, -1}, kFar);
  ASSERT_TRUE(down);
  EXPECT_EQ(down->t, 2);
  const auto up = cross_voxel(below, {0.3, 0.6, -1}, {0, 0, 1}, kFar);
  ASSERT_TRUE(up);
  EXPECT_EQ(up->t, 2);
}

TEST(Voxel, RaysInFacesAndFromSurfacesAreTakenAsTheyAre) {
  const Voxel voxel{{0, 0, 0}, sampled([](const glm::dvec3& w) { return w.z - 0.5; })};
  EXPECT_FLOAT_EQ(cross_voxel(voxel, {0, 0, -1}, {0, 0, 1}, kFar)->t, 1.5f);  // along an edge
  EXPECT_FLOAT_EQ(cross_voxel(voxel, {1, 0.5, -1}, {0, 0, 1}, kFar)->t, 1.5f);
  EXPECT_FALSE(cross_voxel(voxel, {1.001, 0.5, -1}, {0, 0, 1}, kFar));
  EXPECT_FALSE(cross_voxel(voxel, {-1, 0.5, 0.5}, {1, 0, 0}, kFar));  // in the surface
  EXPECT_FALSE(cross_voxel(voxel, {0.5, 0.5, 0.5}, {0, 0, 1}, kFar));
  EXPECT_FALSE(cross_voxel(voxel, {0.5, 0.5, 0.5}, {0, 0, -1}, kFar));
  EXPECT_FALSE(cross_voxel(voxel, {0.5, 0.5, 0.2}, {0, 0, 0}, kFar));
  EXPECT_FALSE(cross_voxel(voxel, {0.5, 0.5, 2}, {0, 0, 1}, kFar));
}

TEST(Voxel, BoxesHoldTheSurface) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  int inside = 0, crossed = 0;
  double volume = 0;
  for (int i = 0; i < 2000; ++i) {
    const Voxel voxel{{1, 2, 3}, random_values(random)};
    if (std::all_of(voxel.values.begin(), voxel.values.end(), is_inside) ||
        std::none_of(voxel.values.begin(), voxel.values.end(), is_inside))
      continue;
    ++crossed;
    const Box box = surface_box(voxel);
    const glm::dvec3 size = box.upper - box.lower;
    volume += size.x * size.y * size.z;
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 o = voxel.lower + 0.5 + random_vector(random);
      const glm::dvec3 d = voxel.lower + glm::dvec3(unit(random), unit(random), unit(random)) - o;
      const auto hit = cross_voxel(voxel, o, d, kFar);
      if (!hit) continue;
      ++inside;
      const glm::dvec3 p = o + double{hit->t} * d;
      for (int a = 0; a < 3; ++a) {
        ASSERT_GE(p[a], box.lower[a] - 1e-6) << i;
        ASSERT_LE(p[a], box.upper[a] + 1e-6) << i;
      }
    }
  }
  EXPECT_GT(inside, 10000);
  EXPECT_LT(volume, 0.95 * crossed);  // they are not simply the voxels
}

}  // namespace
}  // namespace norrsken
