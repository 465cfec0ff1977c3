// Model       No surface at all: light passes straight through.
// Parameters  none
// Measure     delta
// Source      none needed
// Departures  Mitsuba's `path` does not see emitters on such surfaces from the camera and in mirrors, though it does what they
//             light; here they are seen, as by Mitsuba's `volpath` and `direct`
#pragma once

#include "bsdf/bsdf.h"

namespace norrsken::NORRSKEN_ISA {

struct Null {
  static constexpr bool kDelta = true;
  static constexpr bool kUsesLobe = false;

  struct Parameters {};

  static NORRSKEN_INLINE Parameters load(const ParameterReader&) { return {}; }

  static NORRSKEN_INLINE Vec3f evaluate(const Parameters&, const Vec3f&, const Vec3f&) {
    return {Float(0.0f), Float(0.0f), Float(0.0f)};
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters&, const Vec3f&, const Vec3f&) { return Float(0.0f); }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters&, const Vec3f& wo, Float, Vec2f) {
    return {-wo, {Float(1.0f), Float(1.0f), Float(1.0f)}, Float(0.0f), wo.z == wo.z};
  }

  static NORRSKEN_INLINE Vec3f albedo(const Parameters&) { return {Float(1.0f), Float(1.0f), Float(1.0f)}; }
};

}  // namespace norrsken::NORRSKEN_ISA
