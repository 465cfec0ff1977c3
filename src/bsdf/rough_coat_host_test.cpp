// The coat of roughplastic against plain sums over all visible normals.
#include "bsdf/rough_coat_host.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "bsdf/fresnel.h"
#include "bsdf/microfacet.h"

namespace norrsken {
namespace {

using namespace isa_host;

constexpr std::uint32_t kCosines = 9;

/// Means over the midpoints of a grid: what is let through from outside, and reflected inside.
struct Means {
  double transmitted = 0, reflected_inside = 0;
};

Means means_over_grid(const Microfacet& facets, double eta, double cos_theta) {
  constexpr int kSide = 400;
  const Vec3f wo{Float(float(std::sqrt(1 - cos_theta * cos_theta))), Float(0.0f), Float(float(cos_theta))};
  Means means;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int column = i % kSide, row = i / kSide;
    const Vec2f u{Float((float(column) + 0.5f) / kSide), Float((float(row) + 0.5f) / kSide)};
    const Vec3f m = facets.sample_visible(wo, u);
    const Float cos_i = dot(wo, m);
    for (const bool inside : {false, true}) {
      const Float ratio{float(inside ? 1 / eta : eta)};
      const FresnelDielectric f = fresnel_dielectric(cos_i, ratio);
      const Vec3f wi = inside ? reflect(wo, m, cos_i) : refract(wo, m, cos_i, f.cos_t, ratio);
      const double masking = double(facets.masking(wi, m).v) / (kSide * kSide);
      if (inside && wi.z.v > 0) means.reflected_inside += double(f.reflectance.v) * masking;
      if (!inside && wi.z.v < 0) means.transmitted += (1 - double(f.reflectance.v)) * masking;
    }
  }
  return means;
}

TEST(RoughCoat, IsTheMeanOverVisibleNormals) {
  for (const bool ggx : {false, true}) {
    for (const float alpha : {0.02f, 0.3f, 1.5f}) {
      for (const double eta : {1.49, 2.4, 0.67}) {
        SCOPED_TRACE(testing::Message() << (ggx ? "ggx " : "beckmann ") << alpha << " eta " << eta);
        const Microfacet facets{Float(alpha), Float(alpha), Mask{ggx}};
        const RoughCoat coat = integrate_rough_coat(alpha, ggx, eta, kCosines);
        ASSERT_EQ(coat.transmittances.size(), kCosines);
        double from_inside = 0;
        for (std::uint32_t i = 0; i < kCosines; ++i) {
          const double cos_theta = std::max(1e-6, double(i) / (kCosines - 1));
          const Means means = means_over_grid(facets, eta, cos_theta);
          EXPECT_NEAR(coat.transmittances[i], means.transmitted, eta > 1 ? 1e-3 : 6e-3) << cos_theta;
          from_inside += 2 * cos_theta * means.reflected_inside / kCosines;
        }
        EXPECT_NEAR(coat.from_inside, from_inside, 3e-3);
      }
    }
  }
}

/// A scene may have thousands of them.
TEST(RoughCoat, IsSoonIntegrated) {
  constexpr int kCoats = 200;
  const std::clock_t begin = std::clock();
  double sum = 0;
  for (int i = 0; i < kCoats; ++i)
    sum += integrate_rough_coat(0.01f + 0.001f * static_cast<float>(i), i % 2 == 0, 1.3 + 0.001 * i, 64).from_inside;
  const double milliseconds = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_GT(sum, 0);
  // 0.35 each, on a machine of 2023; 12 without what makes it so.
  EXPECT_LT(milliseconds / kCoats, 4);
}

TEST(RoughCoat, IsRememberedByAllThatItDependsOn) {
  const RoughCoat first = rough_coat(0.2, true, 1.5, kCosines);
  EXPECT_NE(rough_coat(0.3, true, 1.5, kCosines).from_inside, first.from_inside);
  EXPECT_NE(rough_coat(0.2, false, 1.5, kCosines).from_inside, first.from_inside);
  EXPECT_NE(rough_coat(0.2, true, 1.4, kCosines).from_inside, first.from_inside);
  EXPECT_EQ(rough_coat(0.2, true, 1.5, 3).transmittances.size(), 3u);
  // Also once more than are kept have been asked for.
  for (int i = 0; i < 100; ++i) rough_coat(0.01 * i + 1e-3, true, 1.5, 2);
  const RoughCoat again = rough_coat(0.2, true, 1.5, kCosines);
  EXPECT_EQ(again.transmittances, first.transmittances);
  EXPECT_EQ(again.from_inside, first.from_inside);
}

}  // namespace
}  // namespace norrsken
