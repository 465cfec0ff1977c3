// Lobes that `principled` and `principledthin` share.
// Source: Burley, "Physically Based Shading at Disney", 2012 (diffuse, sheen, clearcoat); Burley, "Extending the Disney
// BRDF to a BSDF with Integrated Subsurface Scattering", 2015 (diffuse and retro-reflection apart, flatness); weights and
// tints as Mitsuba 3's plugins of these names have them.
#pragma once

#include "bsdf/fresnel.h"
#include "bsdf/microfacet.h"

namespace norrsken::NORRSKEN_ISA {

/// Schlick's (1 - cos)^5.
NORRSKEN_INLINE Float schlick_weight(Float cosine) {
  const Float c = min(max(1.0f - cosine, 0.0f), 1.0f), c2 = c * c;
  return c2 * c2 * c;
}

/// The weight at an interface, whose grazing angles are those on the denser side's outside.
NORRSKEN_INLINE Float schlick_weight(Float cos_i, Float cos_t, Float eta) {
  return schlick_weight(select(eta > 1.0f, cos_i, cos_t));
}

/// From a at 0 to b at 1.
NORRSKEN_INLINE Float mix(Float a, Float b, Float t) { return fma(b - a, t, a); }

/// Reflectance of a dielectric that is met head on.
NORRSKEN_INLINE Float normal_reflectance(Float eta) {
  const Float r = (eta - 1.0f) / (eta + 1.0f);
  return r * r;
}

/// A colour of luminance 1; white for black.
NORRSKEN_INLINE Color tint_of(const Color& color) {
  const Float y = luminance(color);
  const Mask lit = y > 0.0f;
  return select(lit, color * (1.0f / select(lit, y, 1.0f)), white());
}

/// GGX of a roughness between 0 and 1, which is the root of a slope. Source: Burley 2012, section 5.4.
NORRSKEN_INLINE Microfacet facets_of(Float roughness, Float anisotropic) {
  const Float alpha = roughness * roughness;
  const Float aspect = sqrt(max(fnma(anisotropic, 0.9f, 1.0f), 0.0f));
  constexpr float kMin = 1e-3f;
  return {max(alpha / aspect, kMin), max(alpha * aspect, kMin), !Mask::none()};
}

/// Multiple of Lambert's reflectance; cos_d is that of either direction to the one halfway.
/// Source: Burley 2015, equation 4; flatness: Burley 2012, section 5.3 (Hanrahan and Krueger).
NORRSKEN_INLINE Float diffuse_shape(Float roughness, Float flatness, Float cos_o, Float cos_i, Float cos_d) {
  const Float from = schlick_weight(cos_o), to = schlick_weight(cos_i);
  const Float half(0.5f), one(1.0f);
  const Float smooth = fnma(half, from, one) * fnma(half, to, one);
  const Float retro90 = 2.0f * roughness * cos_d * cos_d;
  const Float retro = retro90 * (to + from + to * from * (retro90 - one));
  const Float flat90 = half * retro90;
  const Float flat = mix(one, flat90, to) * mix(one, flat90, from);
  const Float subsurface = 1.25f * fma(flat, one / (cos_o + cos_i) - half, half);
  return mix(smooth + retro, subsurface, flatness);
}

/// Source: Burley 2012, section 5.5.
NORRSKEN_INLINE Color sheen_color(const Color& base_color, Float sheen, Float sheen_tint, Float cos_d) {
  return mix(white(), tint_of(base_color), sheen_tint) * (sheen * schlick_weight(abs(cos_d)));
}

/// The normals of a clear coat: generalised Trowbridge-Reitz of exponent 1. Source: Burley 2012, appendix B.2.
struct ClearcoatNormals {
  Float alpha2;

  NORRSKEN_INLINE Float density(const Vec3f& m) const {
    const Float sin2 = fma(m.x, m.x, m.y * m.y), rest = 1.0f - alpha2;
    return -rest / (kPi * log(alpha2) * fma(sin2, rest, alpha2));
  }
  /// With density(m) m.z over solid angle.
  NORRSKEN_INLINE Vec3f sample(Vec2f u) const {
    const Float sin2 = (pow(alpha2, 1.0f - u.y) - alpha2) / (1.0f - alpha2);
    const Float sin = sqrt(max(sin2, 0.0f));
    const SinCos phi = sin_cos_turns(u.x);
    return {sin * phi.cos, sin * phi.sin, sqrt(max(1.0f - sin2, 0.0f))};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
