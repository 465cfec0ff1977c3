// Model       Scattering by a table over the cosine of the angle, linear between its values.
// Measure     solid angle
// Source      none needed
// Departures  none
#pragma once

#include "medium/phase.h"

namespace norrsken::NORRSKEN_ISA {

struct TabulatedPhase {
  struct Stored {
    static constexpr PhaseKind kKind = PhaseKind::tabphase;
    std::uint32_t segments;  ///< one less than there are values
    std::uint32_t first;     ///< offset in `texels`: the densities over the cosine, then the integrals up to each
  };
  struct Parameters {
    const SceneView& scene;
    UInt segments, first;
    Mask active;

    NORRSKEN_INLINE Float density(UInt i) const { return gather(scene.texels, first + i, active); }
    NORRSKEN_INLINE Float integral(UInt i) const { return gather(scene.texels, first + segments + 1u + i, active); }
  };

  static NORRSKEN_INLINE Parameters load(const PhaseReader& p) {
    return {p.scene, p.get(&Stored::segments), p.get(&Stored::first), p.active};
  }

  static NORRSKEN_INLINE Float over_solid_angle(Float density) { return Float(0.5f * kInvPi) * density; }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Float n = to_float(p.segments);
    const Float at = min(max(fma(scattering_cosine(wo, wi), 0.5f, 0.5f) * n, 0.0f), n);
    const Float low = min(floor(at), n - 1.0f);
    const UInt i = to_uint(low);
    const Float first = p.density(i), second = p.density(i + 1u);
    return over_solid_angle(fma(second - first, at - low, first));
  }

  static NORRSKEN_INLINE PhaseSample sample(const Parameters& p, const Vec3f& wo, Vec2f u) {
    // The segment whose integrals have u between them, by bisection.
    UInt begin = 0u, end = p.segments;
    for (int step = 0; step < 32; ++step) {
      const UInt middle = shift_right<1>(begin + end);
      const Mask open = p.active & (middle != begin);
      if (none(open)) break;
      const Mask below = p.integral(middle) <= u.x;
      begin = select(open & below, middle, begin);
      end = select(open & !below, middle, end);
    }
    const Float first = p.density(begin), second = p.density(begin + 1u), width = 2.0f / to_float(p.segments);
    const Float share = max(u.x - p.integral(begin), 0.0f) / width;
    const Float slope = second - first;
    const Float root = sqrt(max(fma(first, first, 2.0f * slope * share), 0.0f)), sum = first + root;
    const Float t = min(select(sum > 0.0f, 2.0f * share / sum, 0.0f), 1.0f);
    const Float cosine = min(max(fma(to_float(begin) + t, width, -1.0f), -1.0f), 1.0f);
    return {scattered(wo, cosine, u.y), over_solid_angle(fma(slope, t, first))};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
