// Model       A triangle or parallelogram that emits the same radiance in all directions of its front side.
// Parameters  radiance (linear sRGB, W / (m^2 sr))
// Measure     uniform over the area, told as pdf_sa
// Source      Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", 1996
// Departures  none
#pragma once

#include "light/emit.h"

namespace norrsken::NORRSKEN_ISA {

template <bool is_triangle>
struct FlatAreaLight {
  static NORRSKEN_INLINE LightSample sample(const SceneView&, const Light& light, const Vec3f& reference, Vec2f u,
                                            Mask) {
    const Vec2f b = is_triangle ? warp_to_triangle(u) : u;
    const Vec3f point = fma(light.edge1, b.x, fma(light.edge2, b.y, light.origin));
    const Vec3f to_light = point - reference;
    const Float distance2 = dot(to_light, to_light);
    const Float facing = -dot(to_light, light.normal);  // cos at the light, times the distance
    const Float scale = largest(light.origin) + largest(light.edge1) + largest(light.edge2);
    const Float pdf = distance2 * sqrt(distance2) / (facing * light.area);
    return {fma(light.normal, scale * Float(kOffsetUlps), point), pdf, light.emission, facing > Float(0.0f)};
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light& light, const Vec3f&, const Vec3f& direction,
                                      Float distance, Mask) {
    return pdf_sa_from_pdf_area(Float(1.0f) / light.area, distance * distance, -dot(direction, light.normal));
  }

  /// Uniform over the area, cosine-weighted over directions.
  static NORRSKEN_INLINE EmittedRay emit(const SceneView&, const Light& light, Vec2f position, Vec2f direction,
                                         Mask active) {
    const Vec2f b = is_triangle ? warp_to_triangle(position) : position;
    const Vec3f point = fma(light.edge1, b.x, fma(light.edge2, b.y, light.origin));
    const Float scale = largest(light.origin) + largest(light.edge1) + largest(light.edge2);
    return emit_from_surface(point, light.normal, scale, light.area, light.emission, direction, active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
