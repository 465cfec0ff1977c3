// Model       A point that sends the same radiant intensity in all directions.
// Measure     delta
// Source      inverse square law, Kepler 1604
// Departures  none
#pragma once

#include "light/emit.h"

namespace norrsken::NORRSKEN_ISA {

struct PointLight {
  static NORRSKEN_INLINE LightSample sample(const SceneView&, const Light& light, const Vec3f& reference, Vec2f, Mask) {
    const Vec3f to_light = light.origin - reference;
    const Float falloff = 1.0f / dot(to_light, to_light);
    return {light.origin, 1.0f, light.emission * falloff, falloff < Float(__builtin_inff())};
  }

  /// A direction found by other means never meets a point.
  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light&, const Vec3f&, const Vec3f&, Float, Mask) {
    return 0.0f;
  }

  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f, Vec2f direction,
                                         Mask active) {
    return emit_from_point<PointLight>(scene, light, warp_to_sphere(direction), Float(0.25f * kInvPi), active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
