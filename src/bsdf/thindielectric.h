// Model       Thin sheet of a dielectric, such as a window pane: light goes straight on or is reflected, after any
//             number of reflections inside.
// Measure     delta; either part is chosen with the probability of its share
// Source      Stokes, "On the intensity of the light reflected from or transmitted through a pile of plates", 1862: of
//             a plate whose faces reflect r, R = r + (1 - r)^2 r / (1 - r^2) = 2 r / (1 + r)
// Departures  none
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/fresnel.h"

namespace norrsken::NORRSKEN_ISA {

struct ThinDielectric {
  static constexpr bool kDelta = true;
  static constexpr bool kUsesLobe = true;

  struct Parameters {
    Color specular_reflectance, specular_transmittance;
    Float eta;  ///< of the sheet over its surroundings
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::thindielectric;
    ColorSlot specular_reflectance, specular_transmittance;
    float eta;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) {
    return {p.get(&Stored::specular_reflectance), p.get(&Stored::specular_transmittance), p.get(&Stored::eta)};
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters&, const Vec3f&, const Vec3f&) { return black(); }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f&, const Vec3f&) { return 0.0f; }

  static NORRSKEN_INLINE Float reflectance(const Parameters& p, const Vec3f& wo) {
    const Float r = fresnel_dielectric(wo.z, p.eta).reflectance;
    return (r + r) / (1.0f + r);
  }

  static NORRSKEN_INLINE Color straight_on(const Parameters& p, const Vec3f& wo) {
    return p.specular_transmittance * (1.0f - reflectance(p, wo));
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f) {
    const Mask reflects = lobe < reflectance(p, wo);
    return {{-wo.x, -wo.y, select(reflects, wo.z, -wo.z)},
            select(reflects, p.specular_reflectance, p.specular_transmittance),
            0.0f,
            wo.z > 0.0f};
  }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.specular_transmittance; }
};

}  // namespace norrsken::NORRSKEN_ISA
