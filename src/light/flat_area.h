// Model       A triangle or parallelogram that emits from its front, the same in all directions; the radiance may be a
//             texture.
// Parameters  radiance (linear sRGB, W / (m^2 sr))
// Measure     uniform over the area, told as pdf_sa
// Source      Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", 1996
// Departures  none
#pragma once

#include "light/emit.h"

namespace norrsken::NORRSKEN_ISA {

/// The radiance of textured lanes. Parameters: the texture's word, uv at the first corner and its change along the two
/// edges (6 floats), the primitive and the shape (words). Not inlined: few scenes need it, and every BSDF would repeat it.
__attribute__((noinline)) inline Vec3f flat_texture(const SceneView& scene, const Light& light, UInt texture, Vec2f b,
                                                    Mask textured) {
  const auto number = [&](int k) { return gather(scene.parameters + k, light.parameters, textured); };
  const auto word = [&](int k) { return gather_uint(scene.parameters + k, light.parameters, textured); };
  const Vec2f uv{fma(b.x, number(3), fma(b.y, number(5), number(1))),
                 fma(b.x, number(4), fma(b.y, number(6), number(2)))};
  return select(textured, evaluate_texture(scene, texture, {uv, word(7), word(8), b}, textured), light.emission);
}

template <bool is_triangle>
struct FlatAreaLight {
  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f u,
                                            Mask active) {
    const Vec2f b = is_triangle ? warp_to_triangle(u) : u;
    const Vec3f point = fma(light.edge1, b.x, fma(light.edge2, b.y, light.origin));
    const Vec3f to_light = point - reference;
    const Float distance2 = dot(to_light, to_light);
    const Float facing = -dot(to_light, light.normal);  // cos at the light, times the distance
    const Float scale = largest(light.origin) + largest(light.edge1) + largest(light.edge2);
    const Float pdf = distance2 * sqrt(distance2) / (facing * light.area);
    return {fma(light.normal, scale * Float(kOffsetUlps), point), pdf, radiance_at(scene, light, b, active),
            facing > Float(0.0f)};
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light& light, const Vec3f&, const Vec3f& direction,
                                      Float distance, Mask) {
    return pdf_sa_from_pdf_area(Float(1.0f) / light.area, distance * distance, -dot(direction, light.normal));
  }

  /// Uniform over the area, cosine-weighted over directions.
  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f position, Vec2f direction,
                                         Mask active) {
    const Vec2f b = is_triangle ? warp_to_triangle(position) : position;
    const Vec3f point = fma(light.edge1, b.x, fma(light.edge2, b.y, light.origin));
    const Float scale = largest(light.origin) + largest(light.edge1) + largest(light.edge2);
    return emit_from_surface(point, light.normal, scale, light.area, radiance_at(scene, light, b, active), direction,
                             active);
  }

 private:
  static NORRSKEN_INLINE Vec3f radiance_at(const SceneView& scene, const Light& light, Vec2f b, Mask active) {
    const UInt texture = light_texture(scene, light.parameters, active);
    const Mask textured = active & (texture != UInt(0u));
    return any(textured) ? flat_texture(scene, light, texture, b, textured) : light.emission;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
