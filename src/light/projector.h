// Model       A perspective camera run backwards: a point that throws a picture into its field of view. The picture holds
//             pi times the irradiance of the plane at distance 1, so that a white wall there has the picture's radiance,
//             and a picture of one colour lights a wall evenly.
// Measure     delta
// Source      Mitsuba 3, emitter `projector`
// Departures  none
#pragma once

#include "light/emit.h"
#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {

/// edge1, edge2 and normal are the local axes; `emission` is pi times the scale, with the irradiance where that is of
/// one colour.
struct ProjectorLight {
  struct Stored {
    float half_width, half_height;  ///< of the picture at distance 1
    TextureWord texture;
  };

  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f,
                                            Mask active) {
    const Float half(0.5f), one(1.0f);
    const auto stored = [&](auto member) { return gather_slot(scene.parameters, member, light.parameters, active); };
    const Vec3f from_light = reference - light.origin;
    const Float z = dot(light.normal, from_light);
    const Float u = fnma(half, dot(light.edge1, from_light) / (z * stored(&Stored::half_width)), half);
    const Float v = fnma(half, dot(light.edge2, from_light) / (z * stored(&Stored::half_height)), half);
    const Mask lit = (z > 0.0f) & (u >= 0.0f) & (u <= one) & (v >= 0.0f) & (v <= one);
    Color irradiance = light.emission;
    if (scene.texture_kinds != 0) {
      const UInt texture = stored(&Stored::texture);
      const Mask textured = active & lit & (texture != 0u);
      if (any(textured)) {
        const TexturePoint point{{u, v}, {}, {}, {}};
        irradiance = select(textured, irradiance * evaluate_texture(scene, texture, point, textured), irradiance);
      }
    }
    // 1 / (d^2 cos^3), the inverse of the area at distance 1 that a unit of solid angle covers, over d^2.
    const Float distance = sqrt(dot(from_light, from_light));
    return {light.origin, one, irradiance * (distance / (z * z * z)), lit};
  }

  /// A direction found by other means never meets a point.
  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light&, const Vec3f&, const Vec3f&, Float, Mask) {
    return 0.0f;
  }

  /// Uniform over the picture.
  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f, Vec2f direction,
                                         Mask active) {
    const Float half_width = gather_slot(scene.parameters, &Stored::half_width, light.parameters, active);
    const Float half_height = gather_slot(scene.parameters, &Stored::half_height, light.parameters, active);
    const Vec3f local{fms(direction.x, half_width + half_width, half_width),
                      fms(direction.y, half_height + half_height, half_height), 1.0f};
    const Float distance2 = dot(local, local), distance = sqrt(distance2);
    const Float pdf_area = 0.25f / (half_width * half_height);
    return emit_from_axes<ProjectorLight>(scene, light, local,
                                          pdf_sa_from_pdf_area(pdf_area, distance2, 1.0f / distance), active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
