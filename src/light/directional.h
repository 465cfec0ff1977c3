// Model       Parallel light from infinitely far away, from one direction.
// Measure     delta
// Source      Mitsuba 3, emitter `directional`
// Departures  none
#pragma once

#include "light/emit.h"

namespace norrsken::NORRSKEN_ISA {

/// `normal` is the direction in which the light travels; `emission` the irradiance.
struct DirectionalLight {
  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f,
                                            Mask active) {
    return {fma(light.normal, -distance_to_lights_around(scene), reference), 1.0f, light.emission, active};
  }

  /// A direction found by other means never is the light's.
  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light&, const Vec3f&, const Vec3f&, Float, Mask) {
    return 0.0f;
  }

  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f position, Vec2f direction,
                                         Mask active) {
    return emit_from_afar<DirectionalLight>(scene, light, position, direction, active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
