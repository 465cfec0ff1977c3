// Surfaces made of tiny mirrors: the Beckmann and GGX (Trowbridge-Reitz) distributions of their normals, how they mask
// each other, and sampling those that are visible. Normals m have m.z > 0; directions are local and unit.
//
// Parameters  alpha_u, alpha_v: roughness along x and y, root mean square slope (Beckmann); at least 1e-4
// Measure     densities are over the solid angle of m
// Source      distributions and masking: Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
//             2007, equations 25, 27, 33 and 34; anisotropic: Heitz, "Understanding the Masking-Shadowing Function in
//             Microfacet-Based BRDFs", 2014; visible normals: Heitz and d'Eon, "Importance Sampling Microfacet-Based
//             BSDFs using the Distribution of Visible Normals", 2014
// Departures  Beckmann's masking is Walter's rational approximation (equation 27, within 0.35 %) in values, as it is in
//             Mitsuba; densities have the exact one, since they must be those of the samples
#pragma once

#include "math/special.h"
#include "math/warp.h"
#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr float kMinAlpha = 1e-4f;

struct Microfacet {
  Float alpha_u, alpha_v;
  Mask ggx;  ///< else Beckmann

  /// Area of facets with normals around m per projected area: m.z times this integrates to one.
  NORRSKEN_INLINE Float density(const Vec3f& m) const {
    const Float x = m.x / alpha_u, y = m.y / alpha_v, z2 = m.z * m.z;
    const Float slopes = fma(x, x, y * y);
    Float shape = slopes + z2;
    Float exponential(1.0f);
    if (any(!ggx)) {
      exponential = select(ggx, exponential, exp(-slopes / z2));
      shape = select(ggx, shape, z2);
    }
    const Float d = exponential / (kPi * alpha_u * alpha_v * shape * shape);
    // Neither grazing facets, where it is 0 / 0, nor values that underflow in what they are multiplied with.
    return zero_unless(d * m.z > 1e-20f, d);
  }

  /// Share of the facets around m that is visible from v: above the surface those that face up from it, below (v.z < 0)
  /// those that face away.
  NORRSKEN_INLINE Float masking(const Vec3f& v, const Vec3f& m) const {
    const Float tan2 = stretched_tan2(v);
    Float g = 2.0f / (1.0f + sqrt(1.0f + tan2));
    if (any(!ggx)) {
      const Float a = 1.0f / sqrt(tan2);
      const Float rational = a * fma(a, 2.181f, 3.535f) / fma(a, fma(a, 2.577f, 2.276f), 1.0f);
      g = select(ggx, g, select(a < 1.6f, rational, 1.0f));
    }
    return zero_unless(dot(v, m) * v.z > 0.0f, g);
  }

  /// Smith's masking of all facets that face v, v.z > 0, without approximation.
  NORRSKEN_INLINE Float exact_masking(const Vec3f& v) const {
    const Float tan2 = stretched_tan2(v);
    Float g = 2.0f / (1.0f + sqrt(1.0f + tan2));
    if (any(!ggx)) g = select(ggx, g, 2.0f / beckmann_visible_area(sqrt(tan2)));
    return g;
  }

  /// Density of sample_visible; wo.z > 0.
  NORRSKEN_INLINE Float visible_pdf_sa(const Vec3f& wo, const Vec3f& m) const {
    return density(m) * exact_masking(wo) * max(dot(wo, m), 0.0f) / wo.z;
  }

  /// A normal as often as its facets are seen from `wo`; wo.z > 0.
  NORRSKEN_INLINE Vec3f sample_visible(const Vec3f& wo, Vec2f u) const {
    const Vec3f view = stretched(wo);
    Vec3f m{0.0f, 0.0f, 1.0f};
    if (any(ggx)) m = sample_cap(view, sin_cos_turns(u.x), u.y);
    if (any(!ggx)) m = select(ggx, m, sample_visible_beckmann(view, u));
    return stretched_back(m);
  }
  /// The same of GGX alone, for an azimuth that is known.
  NORRSKEN_INLINE Vec3f sample_visible_ggx(const Vec3f& wo, const SinCos& azimuth, Float u) const {
    return stretched_back(sample_cap(stretched(wo), azimuth, u));
  }

 private:
  /// To roughness 1, and normals back from there.
  NORRSKEN_INLINE Vec3f stretched(const Vec3f& v) const { return {v.x * alpha_u, v.y * alpha_v, v.z}; }
  NORRSKEN_INLINE Vec3f stretched_back(const Vec3f& m) const {
    return normalize(Vec3f{m.x * alpha_u, m.y * alpha_v, max(m.z, 1e-7f)});
  }

  /// Squared tangent of v's angle to the normal after the stretch that makes both roughnesses one.
  NORRSKEN_INLINE Float stretched_tan2(const Vec3f& v) const {
    const Float x = v.x * alpha_u, y = v.y * alpha_v;
    return fma(x, x, y * y) / (v.z * v.z);
  }

  /// 2 / G1: the sum that Walter et al. 2007 have in the denominator before equation 27.
  static NORRSKEN_INLINE Float beckmann_visible_area(Float tan_theta) {
    const Float cot = 1.0f / tan_theta;
    return fma(tan_theta * Float(kInvSqrtPi), exp(-cot * cot), 1.0f + erf(cot));
  }

  /// Roughness 1: a point of the hemisphere's part that `wo` sees is halfway to a point of a spherical cap.
  /// Source: Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023, listing 3.
  static NORRSKEN_INLINE Vec3f sample_cap(const Vec3f& stretched, const SinCos& phi, Float u) {
    const Vec3f wo = normalize(stretched);
    const Float z = fma(1.0f - u, 1.0f + wo.z, -wo.z);
    const Float radius = sqrt(max(fnma(z, z, 1.0f), 0.0f));
    return {fma(radius, phi.cos, wo.x), fma(radius, phi.sin, wo.y), z + wo.z};
  }

  /// Roughness 1: slopes along and across the direction of view, of which the first is found by inverting its
  /// cumulative distribution with Newton's method, for the error function of the slope.
  /// Source: Jakob, "An Improved Visible Normal Sampling Routine for the Beckmann Distribution", 2014.
  static NORRSKEN_INLINE Vec3f sample_visible_beckmann(const Vec3f& stretched, Vec2f u) {
    const Float radius2 = fma(stretched.x, stretched.x, stretched.y * stretched.y);
    const Float radius = sqrt(radius2);
    const Float tan_theta = radius / stretched.z;
    const Float end = erf(1.0f / tan_theta);  // the steepest slope that is not turned away
    constexpr float kMargin = 1e-6f;
    const Float share = min(max(u.x, Float(kMargin)), Float(1.0f - kMargin));
    const Float target = share * beckmann_visible_area(tan_theta);
    // Exact where the view is grazing, the hardest case.
    Float x = fnma(end + 1.0f, erf(sqrt(-log(share))), end);
    for (int i = 0; i < 3; ++i) {
      const Float slope = erf_inv(x);
      const Float excess = fma(tan_theta * Float(kInvSqrtPi), exp(-slope * slope), 1.0f + x) - target;
      x = x - excess / fnma(slope, tan_theta, 1.0f);
      x = min(max(x, Float(-kLastErf)), Float(kLastErf));
    }
    const Float along = erf_inv(x);
    const Float across = erf_inv(min(max(fma(u.y, 2.0f, -1.0f), Float(-kLastErf)), Float(kLastErf)));
    const Mask tilted = radius > 0.0f;
    const Float inv_radius = 1.0f / select(tilted, radius, 1.0f);
    const Float cos_phi = select(tilted, stretched.x * inv_radius, 1.0f);
    const Float sin_phi = stretched.y * inv_radius;
    return {fms(sin_phi, across, cos_phi * along), -fma(cos_phi, across, sin_phi * along), 1.0f};
  }

  static constexpr float kInvSqrtPi = 0.564189583547756f;
  static constexpr float kLastErf = 0.99999994f;  ///< the last float before 1
};

/// What a model stores of its facets.
struct RoughnessSlots {
  NumberSlot alpha_u, alpha_v;
  float ggx;  ///< 1, or 0 for Beckmann
};

template <class Stored>
NORRSKEN_INLINE Microfacet load_microfacet(const ParameterReader& p, RoughnessSlots Stored::*facets) {
  return {max(p.get(facets, &RoughnessSlots::alpha_u), Float(kMinAlpha)),
          max(p.get(facets, &RoughnessSlots::alpha_v), Float(kMinAlpha)), p.get(facets, &RoughnessSlots::ggx) > 0.5f};
}

}  // namespace norrsken::NORRSKEN_ISA
