// Model       A surface that emits from its front along its normals only: parallel light from a plane, a fan from a
//             curved or smooth one.
// Measure     delta: nothing but the light's own rays finds it
// Source      Mitsuba 3, emitter `directionalarea`
// Departures  none
#pragma once

#include "light/area_point.h"

namespace norrsken::NORRSKEN_ISA {

/// `Surface` samples the area; with vertex normals it says what they are there.
template <class Surface>
struct AlongNormals {
  static NORRSKEN_INLINE LightSample sample(const SceneView&, const Light&, const Vec3f& reference, Vec2f, Mask) {
    return {reference, 1.0f, black(), Mask::none()};
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light&, const Vec3f&, const Vec3f&, Float, Mask) {
    return 0.0f;
  }

  /// Uniform over the area.
  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f position, Vec2f,
                                         Mask active) {
    const AreaPoint p = Surface::sample_area(scene, light, position, active);
    Vec3f direction = p.normal;
    if constexpr (requires { Surface::shading_normal(scene, light, position, active); }) {
      direction = Surface::shading_normal(scene, light, position, active);
    }
    return {origin_at(p), direction, p.radiance * light.area, p.sampled};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
