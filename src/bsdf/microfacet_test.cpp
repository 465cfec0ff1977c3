// Distributions of microfacet normals: their integrals, and the sampling of visible normals against its density.
#include "bsdf/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace norrsken::isa_host {
namespace {

Vec3f direction(double cos_theta, double phi) {
  const double r = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(cos_theta)};
}

struct Case {
  bool ggx;
  float alpha_u, alpha_v;
  Microfacet facets() const { return {Float(alpha_u), Float(alpha_v), Mask{ggx}}; }
  std::string name() const {
    return std::string(ggx ? "ggx " : "beckmann ") + std::to_string(alpha_u) + " " + std::to_string(alpha_v);
  }
};
const Case kCases[] = {{false, 0.1f, 0.1f}, {true, 0.1f, 0.1f}, {false, 0.6f, 0.2f},    {true, 0.2f, 0.6f},
                       {false, 1.0f, 1.0f}, {true, 1.0f, 1.0f}, {false, 0.003f, 0.01f}, {true, 0.003f, 0.01f}};
const Vec3f kViews[] = {direction(1, 0), direction(0.8, 1), direction(0.3, 4), direction(0.02, 2)};

/// The normal with slopes x, y in units of the roughness, and the solid angle per area of such slopes.
struct SlopePoint {
  Vec3f m;
  double solid_angle;
};
SlopePoint at_slopes(const Case& c, double x, double y) {
  const double sx = -x * double(c.alpha_u), sy = -y * double(c.alpha_v), z = 1 / std::sqrt(1 + sx * sx + sy * sy);
  return {{float(sx * z), float(sy * z), float(z)}, double(c.alpha_u) * double(c.alpha_v) * z * z * z};
}

/// The integral of f(m) over the hemisphere: slopes r (cos phi, sin phi) with r = t / (1 - t).
template <class Function>
double integrate(const Case& c, const Function& f) {
  constexpr int kRings = 2000, kSpokes = 200;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double t = (i + 0.5) / kRings, r = t / (1 - t), dr = 1 / ((1 - t) * (1 - t)) / kRings;
    for (int k = 0; k < kSpokes; ++k) {
      const double phi = 2 * M_PI * (k + 0.5) / kSpokes;
      const SlopePoint p = at_slopes(c, r * std::cos(phi), r * std::sin(phi));
      sum += f(p.m) * p.solid_angle * r * dr * 2 * M_PI / kSpokes;
    }
  }
  return sum;
}

TEST(Microfacet, ProjectedAreaOfAllNormalsIsOne) {
  for (const Case& c : kCases) {
    const double area = integrate(c, [&](const Vec3f& m) { return double(c.facets().density(m).v) * double(m.z.v); });
    EXPECT_NEAR(area, 1.0, 5e-4) << c.name();
  }
}

TEST(Microfacet, VisibleAreaIsThatOfTheSurface) {
  for (const Case& c : kCases) {
    for (const Vec3f& wo : kViews) {
      const double exact = integrate(c, [&](const Vec3f& m) { return double(c.facets().visible_pdf_sa(wo, m).v); });
      EXPECT_NEAR(exact, 1.0, 2e-3) << c.name() << ", view " << wo.z.v;
      // What is masked in values is Walter's approximation of it.
      const double seen = integrate(c, [&](const Vec3f& m) {
        const double facing = std::max(0.0, double(dot(wo, m).v));
        return double(c.facets().density(m).v) * double(c.facets().masking(wo, m).v) * facing;
      });
      EXPECT_NEAR(seen / double(wo.z.v), 1.0, c.ggx ? 2e-3 : 5.5e-3) << c.name() << ", view " << wo.z.v;
    }
  }
}

TEST(Microfacet, MasksWhatFacesAway) {
  for (const Case& c : kCases) {
    const Vec3f m = direction(0.8, 0);
    EXPECT_EQ(c.facets().masking(direction(0.5, M_PI), m).v, 0.0f) << c.name();  // below m's horizon
    EXPECT_GT(c.facets().masking(direction(0.5, 0), m).v, 0.0f) << c.name();
    EXPECT_GT(c.facets().masking(direction(-0.5, M_PI), m).v, 0.0f) << c.name();  // transmitted
    EXPECT_EQ(c.facets().masking(direction(-0.5, 0), m).v, 0.0f) << c.name();
    EXPECT_EQ(c.facets().masking(direction(1, 0), m).v, 1.0f) << c.name();
  }
}

/// Sampled normals against their density: chi-square over a grid of slopes and what lies outside of it.
TEST(Microfacet, VisibleNormalsFollowTheirDensity) {
  constexpr int kSide = 20, kInner = 12, kSamples = 1'000'000;
  constexpr double kReach = 3;
  for (const Case& c : kCases) {
    for (const Vec3f& wo : kViews) {
      std::mt19937 random(3);
      std::uniform_real_distribution<float> unit(0, 1);
      std::vector<double> observed(kSide * kSide + 1);
      for (int i = 0; i < kSamples; ++i) {
        const float a = unit(random), b = unit(random);
        const Vec3f m = c.facets().sample_visible(wo, {Float(a), Float(b)});
        ASSERT_GE(dot(m, wo).v, -1e-4f) << c.name();
        const double x = -double(m.x.v / m.z.v / c.alpha_u), y = -double(m.y.v / m.z.v / c.alpha_v);
        const int column = int(std::floor((x / kReach + 1) / 2 * kSide));
        const int row = int(std::floor((y / kReach + 1) / 2 * kSide));
        const bool inside = column >= 0 && column < kSide && row >= 0 && row < kSide;
        ++observed[std::size_t(inside ? row * kSide + column : kSide * kSide)];
      }
      std::vector<double> expected(kSide * kSide + 1);
      expected.back() = 1;
      for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
          double cell = 0;
          for (int i = 0; i < kInner; ++i) {
            for (int k = 0; k < kInner; ++k) {
              const SlopePoint p = at_slopes(c, ((column + (k + 0.5) / kInner) / kSide * 2 - 1) * kReach,
                                             ((row + (i + 0.5) / kInner) / kSide * 2 - 1) * kReach);
              cell += double(c.facets().visible_pdf_sa(wo, p.m).v) * p.solid_angle;
            }
          }
          cell *= std::pow(2 * kReach / kSide / kInner, 2);
          expected[std::size_t(row * kSide + column)] = cell;
          expected.back() -= cell;
        }
      }
      double chi2 = 0, freedom = -1, pooled_seen = 0, pooled = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const double wanted = expected[i] * kSamples;
        if (wanted < 10) {
          pooled += std::max(0.0, wanted), pooled_seen += observed[i];
          continue;
        }
        chi2 += (observed[i] - wanted) * (observed[i] - wanted) / wanted, ++freedom;
      }
      if (pooled >= 10) chi2 += (pooled_seen - pooled) * (pooled_seen - pooled) / pooled, ++freedom;
      // Wilson and Hilferty: the cube root of chi-square over its freedom is nearly normal. 32 comparisons at 1 % in
      // all (Sidak) are 3.4 standard deviations each.
      const double spread = 2 / (9 * freedom), score = (std::cbrt(chi2 / freedom) - 1 + spread) / std::sqrt(spread);
      EXPECT_LT(score, 3.4) << c.name() << ", view " << wo.z.v << ": chi-square " << chi2 << " of " << freedom;
    }
  }
}

}  // namespace
}  // namespace norrsken::isa_host
