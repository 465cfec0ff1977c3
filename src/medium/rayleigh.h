// Model       Scattering by particles that are much smaller than the wavelength, of light that is not polarised.
// Measure     solid angle
// Source      Rayleigh, "On the light from the sky, its polarization and colour", 1871; inverted as Frisvad, "Importance
//             sampling the Rayleigh phase function", 2011
// Departures  none
#pragma once

#include "medium/phase.h"

namespace norrsken::NORRSKEN_ISA {

struct Rayleigh {
  struct Stored {
    static constexpr PhaseKind kKind = PhaseKind::rayleigh;
    float unused;
  };
  struct Parameters {};

  static NORRSKEN_INLINE Parameters load(const PhaseReader&) { return {}; }

  static NORRSKEN_INLINE Float of_cosine(Float cosine) { return Float(0.1875f * kInvPi) * fma(cosine, cosine, 1.0f); }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f& wo, const Vec3f& wi) {
    return of_cosine(scattering_cosine(wo, wi));
  }

  static NORRSKEN_INLINE PhaseSample sample(const Parameters&, const Vec3f& wo, Vec2f u) {
    // cos^3 + 3 cos = z, which Cardano's formula solves; for its size, as nothing cancels there.
    const Float z = fma(u.x, 4.0f, -2.0f), size = abs(z);
    const Float root = exp(log(size + sqrt(fma(size, size, 1.0f))) * (1.0f / 3.0f));
    const Float cosine = copysign(min(root - 1.0f / root, 1.0f), z);
    return {scattered(wo, cosine, u.y), of_cosine(cosine)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
