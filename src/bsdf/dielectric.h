// Model       Smooth dielectric: an interface that reflects and refracts, as glass and water do.
// Measure     delta; either part is chosen with the probability of its share
// Source      Born and Wolf, "Principles of Optics", section 1.5.2; radiance grows by eta^2 as it enters: Veach,
//             "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 5.2
// Departures  none
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/fresnel.h"

namespace norrsken::NORRSKEN_ISA {

struct Dielectric {
  static constexpr bool kDelta = true;
  static constexpr bool kUsesLobe = true;

  struct Parameters {
    Color specular_reflectance, specular_transmittance;
    Float eta;  ///< of the other side over this side
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::dielectric;
    ColorSlot specular_reflectance, specular_transmittance;
    float eta;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) {
    return {p.get(&Stored::specular_reflectance), p.get(&Stored::specular_transmittance), p.get(&Stored::eta)};
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters&, const Vec3f&, const Vec3f&) { return black(); }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f&, const Vec3f&) { return 0.0f; }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f) {
    const FresnelDielectric f = fresnel_dielectric(wo.z, p.eta);
    const Mask reflects = lobe < f.reflectance;
    const Float inv_eta = 1.0f / p.eta;
    const Vec3f mirrored{-wo.x, -wo.y, wo.z}, refracted{-wo.x * inv_eta, -wo.y * inv_eta, -f.cos_t};
    const Color transmitted = p.specular_transmittance * (inv_eta * inv_eta);
    return {select(reflects, mirrored, refracted), select(reflects, p.specular_reflectance, transmitted), 0.0f,
            wo.z > 0.0f, select(reflects, 1.0f, p.eta)};
  }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.specular_transmittance; }
};

}  // namespace norrsken::NORRSKEN_ISA
