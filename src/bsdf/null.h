// Model       No surface at all: light passes straight through.
// Measure     delta
// Source      none needed
// Departures  see null.cpp
#pragma once

#include "bsdf/bsdf.h"

namespace norrsken::NORRSKEN_ISA {

struct Null {
  static constexpr bool kDelta = true;
  static constexpr bool kUsesLobe = false;

  struct Parameters {};

  static NORRSKEN_INLINE Parameters load(const ParameterReader&) { return {}; }

  static NORRSKEN_INLINE Color evaluate(const Parameters&, const Vec3f&, const Vec3f&) { return black(); }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f&, const Vec3f&) { return 0.0f; }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters&, const Vec3f& wo, Float, Vec2f) {
    return {-wo, white(), 0.0f, wo.z == wo.z};
  }

  static NORRSKEN_INLINE Color straight_on(const Parameters&, const Vec3f&) { return white(); }

  static NORRSKEN_INLINE Color albedo(const Parameters&) { return white(); }
};

}  // namespace norrsken::NORRSKEN_ISA
