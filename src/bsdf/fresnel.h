// Reflection and refraction at a smooth interface: Fresnel's equations and the directions that they weigh.
// `eta` is the index of refraction beyond the interface over that on the side of the ray. Cosines are those to the
// normal on the ray's side, in [0, 1].
// Source: Born and Wolf, "Principles of Optics", sections 1.5.2 (dielectrics) and 14.2 (metals).
#pragma once

#include "color/color.h"
#include "math/warp.h"

namespace norrsken::NORRSKEN_ISA {

struct FresnelDielectric {
  Float reflectance;  ///< of unpolarised light; 1 where it is reflected totally
  Float cos_t;        ///< of the refracted direction to the normal beyond, 0 where there is none
};

NORRSKEN_INLINE FresnelDielectric fresnel_dielectric(Float cos_i, Float eta) {
  const Float inv_eta = 1.0f / eta;
  const Float sin2_t = fnma(cos_i, cos_i, 1.0f) * inv_eta * inv_eta;
  const Float cos_t = sqrt(max(1.0f - sin2_t, 0.0f));
  const Float r_s = fnma(eta, cos_t, cos_i) / fma(eta, cos_t, cos_i);
  const Float r_p = fms(eta, cos_i, cos_t) / fma(eta, cos_i, cos_t);
  // Without the two exceptions 0 / 0 for grazing rays.
  const Float grazing = select(eta == 1.0f, Float(0.0f), Float(1.0f));
  return {select(cos_i > 0.0f, 0.5f * fma(r_s, r_s, r_p * r_p), grazing), cos_t};
}

/// Reflectance of a metal with index eta + i k, seen from the vacuum, for unpolarised light.
NORRSKEN_INLINE Float fresnel_conductor(Float cos_i, Float eta, Float k) {
  const Float cos2 = cos_i * cos_i, sin2 = 1.0f - cos2;
  // (a + i b)^2 = (eta + i k)^2 - sin^2
  const Float difference = fms(eta, eta, fma(k, k, sin2));
  const Float twice_ab = 2.0f * eta * k;
  const Float a2_plus_b2 = sqrt(fma(difference, difference, twice_ab * twice_ab));
  const Float a = sqrt(max(0.5f * (a2_plus_b2 + difference), 0.0f));
  const Float sum_s = a2_plus_b2 + cos2, twice_a_cos = 2.0f * a * cos_i;
  const Float sum_p = fma(a2_plus_b2, cos2, sin2 * sin2), twice_p = twice_a_cos * sin2;
  const Float r_s = (sum_s - twice_a_cos) / (sum_s + twice_a_cos);
  const Float r_p = r_s * (sum_p - twice_p) / (sum_p + twice_p);
  return 0.5f * (r_s + r_p);
}

NORRSKEN_INLINE Color fresnel_conductor(Float cos_i, const Color& eta, const Color& k) {
  return {fresnel_conductor(cos_i, eta.r, k.r), fresnel_conductor(cos_i, eta.g, k.g),
          fresnel_conductor(cos_i, eta.b, k.b)};
}

/// The mirror image of `wo`, where cos_i = dot(wo, m).
NORRSKEN_INLINE Vec3f reflect(const Vec3f& wo, const Vec3f& m, Float cos_i) { return fma(m, cos_i + cos_i, -wo); }

/// Where `wo` goes on beyond the interface with normal m.
NORRSKEN_INLINE Vec3f refract(const Vec3f& wo, const Vec3f& m, Float cos_i, Float cos_t, Float eta) {
  const Float inv_eta = 1.0f / eta;
  return fma(m, fms(cos_i, inv_eta, cos_t), wo * -inv_eta);
}

}  // namespace norrsken::NORRSKEN_ISA
