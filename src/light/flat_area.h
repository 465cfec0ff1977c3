// Model       A triangle or parallelogram that emits from its front, the same in all directions; the radiance may be a
//             texture.
// Measure     uniform over the area, told as pdf_sa
// Source      Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", 1996
// Departures  none
#pragma once

#include "light/area_point.h"

namespace norrsken::NORRSKEN_ISA {

/// Of textured ones, and of those that shine along the normals of smooth meshes.
struct FlatAreaStored {
  TextureWord texture;
  float u, v;                              ///< at the first corner
  float left_u, left_v, right_u, right_v;  ///< how much they change along the two edges
  std::uint32_t primitive, shape;
};

/// The radiance of textured lanes. Not inlined: few scenes need it, and every BSDF would repeat it.
__attribute__((noinline)) inline Color flat_texture(const SceneView& scene, UInt parameters, Color emission,
                                                    UInt texture, Vec2f b, Mask textured) {
  using Stored = FlatAreaStored;
  const auto stored = [&](auto member) { return gather_slot(scene.parameters, member, parameters, textured); };
  const Vec2f uv{fma(b.x, stored(&Stored::left_u), fma(b.y, stored(&Stored::right_u), stored(&Stored::u))),
                 fma(b.x, stored(&Stored::left_v), fma(b.y, stored(&Stored::right_v), stored(&Stored::v)))};
  const TexturePoint point{uv, stored(&Stored::primitive), stored(&Stored::shape), b};
  return select(textured, evaluate_texture(scene, texture, point, textured), emission);
}

/// The shading normals of triangles of smooth meshes, with parameters as above; the light's first corner is the
/// triangle's.
__attribute__((noinline)) inline Vec3f flat_shading_normal(const SceneView& scene, UInt parameters, Vec3f normal,
                                                           Vec2f b, Mask active) {
  const auto stored = [&](auto member) { return gather_slot(scene.parameters, member, parameters, active); };
  const UInt shape = stored(&FlatAreaStored::shape);
  const Mask smooth = active & (gather(scene.shapes, &ShapeRecord::smooth, shape, active) != 0u);
  const UInt first = stored(&FlatAreaStored::primitive) * 3u;
  Vec3f normals[3];
  for (int k = 0; k < 3; ++k) {
    normals[k] = gather3(scene.normals, gather(scene.triangle_vertices + k, first, smooth) * 3u, smooth);
  }
  const Vec3f sum = fma(normals[1], b.x, fma(normals[2], b.y, normals[0] * (1.0f - b.x - b.y)));
  return select(smooth, normalize(sum), normal);
}

template <bool is_triangle>
struct FlatAreaLight {
  template <class Scene>
  static NORRSKEN_INLINE LightSample sample(const Scene& scene, const Light& light, const Vec3f& reference, Vec2f u,
                                            Mask active) {
    return seen_from(reference, sample_area(scene, light, u, active), light.area);
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light& light, const Vec3f&, const Vec3f& direction,
                                      Float distance, Mask) {
    return pdf_sa_from_pdf_area(1.0f / light.area, distance * distance, -dot(direction, light.normal));
  }

  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f position, Vec2f direction,
                                         Mask active) {
    return emit_from_surface(sample_area(scene, light, position, active), light.area, direction);
  }

  template <class Scene>
  static NORRSKEN_INLINE AreaPoint sample_area(const Scene& scene, const Light& light, Vec2f u, Mask active) {
    const Vec2f b = barycentric(u);
    const Vec3f point = fma(light.edge1, b.x, fma(light.edge2, b.y, light.origin));
    const Float scale = largest(light.origin) + largest(light.edge1) + largest(light.edge2);
    return {point, light.normal, radiance_at(scene, light, b, active), scale, active};
  }

  /// Interpolated between the vertices' where they have normals; such triangles have parameters.
  static NORRSKEN_INLINE Vec3f shading_normal(const SceneView& scene, const Light& light, Vec2f u,
                                              Mask active) requires is_triangle {
    const Mask smooth = active & (light.parameters != kNone);
    if (!scene.any_smooth || none(smooth)) return light.normal;
    return flat_shading_normal(scene, light.parameters, copied(light.normal), barycentric(u), smooth);
  }

 private:
  static NORRSKEN_INLINE Vec2f barycentric(Vec2f u) { return is_triangle ? warp_to_triangle(u) : u; }

  template <class Scene>
  static NORRSKEN_INLINE Color radiance_at(const Scene& scene, const Light& light, Vec2f b, Mask active) {
    const UInt texture = light_texture(scene, light.parameters, active);
    const Mask textured = active & (texture != 0u);
    return any(textured) ? flat_texture(scene, light.parameters, copied(light.emission), texture, b, textured)
                         : light.emission;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
