// Fresnel's equations against complex arithmetic in double, energy, and closed forms.
#include "bsdf/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "bsdf/fresnel_host.h"

namespace norrsken::isa_host {
namespace {

/// Reflectance for a complex index, from the amplitudes themselves.
double reference(double cos_i, std::complex<double> index) {
  const std::complex<double> cos_t = std::sqrt(1.0 - (1 - cos_i * cos_i) / (index * index));
  const auto r_s = (cos_i - index * cos_t) / (cos_i + index * cos_t);
  const auto r_p = (index * cos_i - cos_t) / (index * cos_i + cos_t);
  return (std::norm(r_s) + std::norm(r_p)) / 2;
}

TEST(FresnelDielectric, IsThatOfTheAmplitudes) {
  for (const double eta : {1.0003, 1.33, 1.5, 2.4, 1 / 1.33, 1 / 1.5, 0.4}) {
    for (int i = 0; i <= 1000; ++i) {
      const float c = float(i) / 1000;
      const FresnelDielectric f = fresnel_dielectric(Float(c), Float(float(eta)));
      const double index = double(float(eta)), sin2 = (1 - double(c) * double(c)) / (index * index);
      const double slope = index > 1.1 || index < 0.9 ? 0 : 2e-3;  // ill-conditioned where nothing is bent
      EXPECT_NEAR(double(f.reflectance.v), sin2 >= 1 ? 1.0 : reference(double(c), index), 3e-6 + slope) << c;
      // A square root next to total reflection.
      EXPECT_NEAR(double(f.cos_t.v), std::sqrt(std::max(0.0, 1 - sin2)), std::abs(1 - sin2) < 1e-2 ? 5e-4 : 3e-6);
    }
  }
}

TEST(FresnelDielectric, ReflectsTotallyBeyondTheCriticalAngle) {
  const double critical = std::sqrt(1 - 1 / (1.5 * 1.5));  // seen from inside
  const FresnelDielectric beyond = fresnel_dielectric(Float(float(critical - 1e-3)), Float(1 / 1.5f));
  EXPECT_EQ(beyond.reflectance.v, 1.0f);
  EXPECT_EQ(beyond.cos_t.v, 0.0f);
  EXPECT_LT(fresnel_dielectric(Float(float(critical + 1e-3)), Float(1 / 1.5f)).reflectance.v, 0.9f);
}

TEST(FresnelDielectric, KeepsItsHeadAtTheEdges) {
  EXPECT_EQ(fresnel_dielectric(Float(0.0f), Float(1.5f)).reflectance.v, 1.0f);
  EXPECT_EQ(fresnel_dielectric(Float(0.0f), Float(0.5f)).reflectance.v, 1.0f);
  EXPECT_EQ(fresnel_dielectric(Float(0.0f), Float(1.0f)).reflectance.v, 0.0f);
  for (int i = 1; i <= 100; ++i)
    EXPECT_NEAR(fresnel_dielectric(Float(float(i) / 100), Float(1.0f)).reflectance.v, 0, 1e-6);
  EXPECT_NEAR(double(fresnel_dielectric(Float(1.0f), Float(1.5f)).reflectance.v), 0.04, 1e-7);
}

TEST(FresnelConductor, IsThatOfTheAmplitudes) {
  for (const std::complex<double> index : {std::complex<double>(0.2, 3.4), {1.65, 9.2}, {2.9, 0.9}, {1.5, 0.0}}) {
    for (int i = 0; i <= 1000; ++i) {
      const float c = float(i) / 1000;
      const Float f = fresnel_conductor(Float(c), Float(float(index.real())), Float(float(index.imag())));
      EXPECT_NEAR(double(f.v), reference(double(c), index), 5e-6) << c << " " << index;
    }
  }
}

TEST(FresnelConductor, OfIndexZeroReflectsEverything) {
  for (int i = 0; i <= 100; ++i) {
    EXPECT_NEAR(double(fresnel_conductor(Float(float(i) / 100), Float(0.0f), Float(1.0f)).v), 1.0, 1e-6);
  }
}

TEST(Refraction, FollowsSnellsLaw) {
  for (const float eta : {1.5f, 1 / 1.5f, 2.4f, 1.0f}) {
    for (int i = 1; i <= 100; ++i) {
      const double cos_i = i / 100.0, sin_i = std::sqrt(1 - cos_i * cos_i);
      const Vec3f m{Float(0.6f), Float(0.0f), Float(0.8f)}, side{Float(0.8f), Float(0.0f), Float(-0.6f)};
      const Vec3f wo = fma(m, Float(float(cos_i)), side * Float(float(sin_i)));
      const Vec3f mirrored = reflect(wo, m, Float(float(cos_i)));
      EXPECT_NEAR(double(dot(mirrored, m).v), cos_i, 1e-6);
      EXPECT_NEAR(double(dot(mirrored, side).v), -sin_i, 1e-6);
      const FresnelDielectric f = fresnel_dielectric(Float(float(cos_i)), Float(eta));
      if (f.cos_t.v == 0.0f) continue;
      const Vec3f wi = refract(wo, m, Float(float(cos_i)), f.cos_t, Float(eta));
      EXPECT_NEAR(double(dot(wi, wi).v), 1.0, 2e-6);
      EXPECT_NEAR(double(dot(wi, m).v), -double(f.cos_t.v), 1e-6);
      EXPECT_NEAR(double(dot(wi, side).v) * double(eta), -sin_i, 2e-6);
    }
  }
}

/// Source: Duntley, "The Optical Properties of Diffusing Materials", 1942.
double diffuse_closed_form(double n) {
  const double n2 = n * n, n4 = n2 * n2;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
         2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
         8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

/// From inside the rest of what crosses: the same flux does in both directions between media of radiance 1 and eta^2.
double diffuse_from_inside(double n) { return 1 - (1 - diffuse_closed_form(n)) / (n * n); }

TEST(FresnelDiffuse, IsNearItsClosedForm) {
  for (double n = 1.02; n <= 2; n += 0.02) {
    EXPECT_NEAR(fresnel_diffuse_reflectance(n), diffuse_closed_form(n), 1e-3) << n;
    EXPECT_NEAR(fresnel_diffuse_reflectance(1 / n), diffuse_from_inside(n), 1e-3) << n;
  }
  EXPECT_NEAR(fresnel_diffuse_reflectance(1 / 2.42), diffuse_from_inside(2.42), 5e-3);
}

/// What Mitsuba 3.9's fresnel_diffuse_reflectance says.
TEST(FresnelDiffuse, IsTheFitThatMitsubaTakes) {
  const double known[][2] = {{1.000277 / 1.333, 0.47476310}, {1 / 1.9, 0.76370734}, {1.000277 / 2.419, 0.86924803},
                             {1 / 3.0, 0.93554443},          {1.25, 0.05290264},    {1.6, 0.10626353}};
  for (const auto& [eta, reflectance] : known) EXPECT_NEAR(fresnel_diffuse_reflectance(eta), reflectance, 5e-7) << eta;
}

}  // namespace
}  // namespace norrsken::isa_host
