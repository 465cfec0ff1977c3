// Model       Light is scattered alike into all directions.
// Measure     solid angle
// Source      none needed
// Departures  none
#pragma once

#include "medium/phase.h"

namespace norrsken::NORRSKEN_ISA {

struct Isotropic {
  struct Stored {
    static constexpr PhaseKind kKind = PhaseKind::isotropic;
    float unused;
  };
  struct Parameters {};

  static NORRSKEN_INLINE Parameters load(const PhaseReader&) { return {}; }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f&, const Vec3f&) { return 0.25f * kInvPi; }

  static NORRSKEN_INLINE PhaseSample sample(const Parameters&, const Vec3f&, Vec2f u) {
    return {warp_to_sphere(u), 0.25f * kInvPi};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
