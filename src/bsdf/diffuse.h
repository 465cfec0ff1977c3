// Model       Lambertian reflection: the same radiance in every direction of the upper hemisphere.
// Measure     pdf_sa, cosine-weighted
// Source      Lambert, "Photometria", 1760
// Departures  none
#pragma once

#include "bsdf/bsdf.h"

namespace norrsken::NORRSKEN_ISA {

struct Diffuse {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = false;

  struct Parameters {
    Color reflectance;
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::diffuse;
    ColorSlot reflectance;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) { return {p.get(&Stored::reflectance)}; }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Float cos_i = max(wi.z, 0.0f);
    return p.reflectance * zero_unless(wo.z > 0.0f, cos_i * kInvPi);
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f& wo, const Vec3f& wi) {
    return zero_unless(wo.z > 0.0f, cosine_hemisphere_pdf_sa(wi.z));
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float, Vec2f direction) {
    const Vec3f wi = warp_to_cosine_hemisphere(direction);
    return {wi, p.reflectance, cosine_hemisphere_pdf_sa(wi.z), (wo.z > 0.0f) & (wi.z > 0.0f)};
  }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.reflectance; }
};

}  // namespace norrsken::NORRSKEN_ISA
