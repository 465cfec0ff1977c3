// Model       The same radiance from everywhere around the scene.
// Measure     pdf_sa: uniform over the sphere of directions
// Source      none needed
// Departures  none
#pragma once

#include "light/emit.h"

namespace norrsken::NORRSKEN_ISA {

struct ConstantEnvironment {
  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f u,
                                            Mask active) {
    const Vec3f direction = warp_to_sphere(u);
    return {fma(direction, distance_to_lights_around(scene), reference), Float(0.25f * kInvPi), light.emission, active};
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light&, const Vec3f&, const Vec3f&, Float, Mask) {
    return Float(0.25f * kInvPi);
  }

  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f position, Vec2f direction,
                                         Mask active) {
    return emit_from_afar<ConstantEnvironment>(scene, light, position, direction, active);
  }

  static NORRSKEN_INLINE SeenLight seen(const SceneView&, const Light& light, const Vec3f&, Mask) {
    return {light.emission, Float(0.25f * kInvPi)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
