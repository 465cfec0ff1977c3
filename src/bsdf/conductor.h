// Model       Smooth conductor: a mirror of metal.
// Measure     delta
// Source      Born and Wolf, "Principles of Optics", section 14.2
// Departures  none
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/fresnel.h"

namespace norrsken::NORRSKEN_ISA {

struct Conductor {
  static constexpr bool kDelta = true;
  static constexpr bool kUsesLobe = false;

  struct Parameters {
    Color specular_reflectance, eta, k;
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::conductor;
    ColorSlot specular_reflectance, eta, k;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) {
    return {p.get(&Stored::specular_reflectance), p.get(&Stored::eta), p.get(&Stored::k)};
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters&, const Vec3f&, const Vec3f&) { return black(); }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f&, const Vec3f&) { return 0.0f; }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float, Vec2f) {
    const Color fresnel = fresnel_conductor(wo.z, p.eta, p.k);
    return {{-wo.x, -wo.y, wo.z}, p.specular_reflectance * fresnel, 0.0f, wo.z > 0.0f};
  }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) {
    return p.specular_reflectance * fresnel_conductor(1.0f, p.eta, p.k);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
