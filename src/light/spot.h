// Model       A point that shines into a cone around a direction, perhaps through a picture: full intensity in a beam
//             around the axis, from there falling linearly with the angle to nothing at the cone's edge.
// Measure     delta
// Source      Mitsuba 3, emitter `spot`
// Departures  none
#pragma once

#include "light/emit.h"
#include "math/special.h"
#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {

/// edge1, edge2 and normal are the local axes as rows of the matrix that takes directions of the world there.
struct SpotLight {
  struct Stored {
    float cutoff, cos_cutoff, cos_beam;
    float inverse_width;  ///< 1 / (cutoff - beam)
    float inverse_tan_cutoff;
    TextureWord texture;
  };

  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f,
                                            Mask active) {
    const auto stored = [&](auto member) { return gather_slot(scene.parameters, member, light.parameters, active); };
    const Vec3f from_light = reference - light.origin;
    const Vec3f local{dot(light.edge1, from_light), dot(light.edge2, from_light), dot(light.normal, from_light)};
    const Float cos_theta = local.z / sqrt(dot(local, local));
    const Float slope = (stored(&Stored::cutoff) - acos(cos_theta)) * stored(&Stored::inverse_width);
    const Float falloff = select(cos_theta >= stored(&Stored::cos_beam), 1.0f, slope);
    const Float inverse_square = 1.0f / dot(from_light, from_light);
    const Mask lit = (cos_theta > stored(&Stored::cos_cutoff)) & (falloff > 0.0f) & (inverse_square < Float(kInf));
    Color intensity = light.emission * falloff;
    if (scene.texture_kinds != 0) {
      const UInt texture = stored(&Stored::texture);
      const Mask textured = active & lit & (texture != 0u);
      if (any(textured)) {
        const Float half = 0.5f * stored(&Stored::inverse_tan_cutoff) / local.z;
        const TexturePoint point{{fma(local.x, half, 0.5f), fma(local.y, half, 0.5f)}, {}, {}, {}};
        intensity = select(textured, intensity * evaluate_texture(scene, texture, point, textured), intensity);
      }
    }
    return {light.origin, 1.0f, intensity * inverse_square, lit};
  }

  /// A direction found by other means never meets a point.
  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light&, const Vec3f&, const Vec3f&, Float, Mask) {
    return 0.0f;
  }

  /// Uniform over the cone.
  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f, Vec2f direction,
                                         Mask active) {
    const Float one_minus_cos = 1.0f - gather_slot(scene.parameters, &Stored::cos_cutoff, light.parameters, active);
    return emit_from_axes<SpotLight>(scene, light, warp_to_cone(direction, one_minus_cos), cone_pdf_sa(one_minus_cos),
                                     active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
