// Model       Scattering that prefers the forward or the backward direction, by its mean cosine g.
// Measure     solid angle
// Source      Henyey and Greenstein, "Diffuse radiation in the galaxy", 1941
// Departures  none
#pragma once

#include "medium/phase.h"

namespace norrsken::NORRSKEN_ISA {

struct HenyeyGreenstein {
  struct Stored {
    static constexpr PhaseKind kKind = PhaseKind::hg;
    float g;
  };
  struct Parameters {
    Float g;
  };

  static NORRSKEN_INLINE Parameters load(const PhaseReader& p) { return {p.get(&Stored::g)}; }

  static NORRSKEN_INLINE Float of_cosine(Float g, Float cosine) {
    // 1 + g^2 - 2 g cos, without cancellation where g and the cosine are close to 1.
    const Float rest = 1.0f - g;
    const Float base = max(fma(2.0f * g, 1.0f - cosine, rest * rest), 1e-20f);
    return 0.25f * kInvPi * (rest * (1.0f + g)) / (base * sqrt(base));
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return of_cosine(p.g, scattering_cosine(wo, wi));
  }

  static NORRSKEN_INLINE PhaseSample sample(const Parameters& p, const Vec3f& wo, Vec2f u) {
    // The inverse of the distribution of cosines, and the straight line that it is for small g.
    const Mask straight = abs(p.g) < 1e-3f;
    const Float g = select(straight, 1.0f, p.g);
    const Float root = (1.0f - g) * (1.0f + g) / fma(2.0f * g, u.x, 1.0f - g);
    const Float inverted = fnma(root, root, fma(g, g, 1.0f)) / (2.0f * g);
    const Float cosine = min(max(select(straight, fma(u.x, 2.0f, -1.0f), inverted), -1.0f), 1.0f);
    return {scattered(wo, cosine, u.y), of_cosine(p.g, cosine)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
