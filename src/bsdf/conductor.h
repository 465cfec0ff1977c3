// Model       Smooth conductor with material "none": a mirror that reflects everything, tinted by a factor.
// Parameters  specular_reflectance (linear sRGB, 0 to 1, default 1)
// Measure     delta
// Source      the law of reflection; Fresnel's factor is 1 for material "none"
// Departures  none
#pragma once

#include "bsdf/bsdf.h"

namespace norrsken::NORRSKEN_ISA {

struct Conductor {
  static constexpr bool kDelta = true;
  static constexpr bool kUsesLobe = false;

  struct Parameters {
    Vec3f specular_reflectance;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) { return {p.color(0)}; }

  static NORRSKEN_INLINE Vec3f evaluate(const Parameters&, const Vec3f&, const Vec3f&) {
    return {Float(0.0f), Float(0.0f), Float(0.0f)};
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f&, const Vec3f&) { return Float(0.0f); }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float, Vec2f) {
    return {{-wo.x, -wo.y, wo.z}, p.specular_reflectance, Float(0.0f), wo.z > Float(0.0f)};
  }

  static NORRSKEN_INLINE Vec3f albedo(const Parameters& p) { return p.specular_reflectance; }
};

}  // namespace norrsken::NORRSKEN_ISA
