// Distributions of microfacet normals: their integrals, and the sampling of visible normals against its density.
#include "bsdf/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "tests/statistics/statistical_test.h"

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

/// Sampled normals against their density, over their slopes in units of the roughness.
TEST(Microfacet, VisibleNormalsFollowTheirDensity) {
  constexpr double kReach = 3;
  statistics::StatisticalTest test;
  for (const Case& c : kCases) {
    for (const Vec3f& wo : kViews) {
      const statistics::Sampling sampling{{{-kReach, -kReach}, {kReach, kReach}},
                                          {"slope along u over alpha_u", "slope along v over alpha_v"},
                                          [&](statistics::Random& random) -> std::optional<statistics::Point> {
                                            const float a = random(), b = random();
                                            const Vec3f m = c.facets().sample_visible(wo, {Float(a), Float(b)});
                                            EXPECT_GE(dot(m, wo).v, -1e-4f) << c.name();
                                            const double z{m.z.v}, x = -double{m.x.v} / z / double{c.alpha_u},
                                                                   y = -double{m.y.v} / z / double{c.alpha_v};
                                            if (!(std::abs(x) < kReach && std::abs(y) < kReach)) return std::nullopt;
                                            return statistics::Point{x, y};
                                          },
                                          [&](const statistics::Point& slopes) {
                                            const SlopePoint p = at_slopes(c, slopes[0], slopes[1]);
                                            return double{c.facets().visible_pdf_sa(wo, p.m).v} * p.solid_angle;
                                          }};
      EXPECT_TRUE(test.follows_density(sampling, c.name() + ", view " + std::to_string(wo.z.v)));
    }
  }
}

}  // namespace
}  // namespace norrsken::isa_host
