// What lights give to the paths that start at them.
#pragma once

#include "light/light.h"

namespace norrsken::NORRSKEN_ISA {

/// A ray from a light. `weight` is its radiance times the cosine there over the density of position and direction, or
/// whatever becomes of that where they are deltas: flux, if all rays were like this one.
struct EmittedRay {
  Vec3f origin;  ///< moved off the light by the rounding bound
  Vec3f direction;
  Color weight;
  Mask valid;
};

/// Of a point that shines into `direction`, which was found with `pdf_sa`: what `sample` says of a place there.
template <class Model>
NORRSKEN_INLINE EmittedRay emit_from_point(const SceneView& scene, const Light& light, const Vec3f& direction,
                                           Float pdf_sa, Mask active) {
  // So far away that the place is told as precisely as the direction.
  const Float distance = largest(light.origin) + 1.0f;
  const LightSample seen = Model::sample(scene, light, fma(direction, distance, light.origin), {0.0f, 0.0f}, active);
  return {light.origin, direction, seen.radiance * (distance * distance / pdf_sa), seen.valid};
}

/// The same of a point with axes of its own, which are the rows of what takes directions of the world there (edge1,
/// edge2, normal); `local`, of any length, and the density of its direction are in that space.
template <class Model>
NORRSKEN_INLINE EmittedRay emit_from_axes(const SceneView& scene, const Light& light, const Vec3f& local,
                                          Float local_pdf_sa, Mask active) {
  const Vec3f x = cross(light.edge2, light.normal), y = cross(light.normal, light.edge1),
              z = cross(light.edge1, light.edge2);
  const Float determinant = dot(light.normal, z);
  const Vec3f along = fma(x, local.x, fma(y, local.y, z * local.z)) * copysign(1.0f, determinant);
  const Vec3f direction = normalize(along);
  const Vec3f back{dot(light.edge1, direction), dot(light.edge2, direction), dot(light.normal, direction)};
  const Float length2 = dot(back, back);
  // The solid angle there of a unit of solid angle in the world.
  const Float jacobian = abs(determinant) / (length2 * sqrt(length2));
  return emit_from_point<Model>(scene, light, direction, local_pdf_sa * jacobian, active);
}

/// Of a light infinitely far away: into the opposite of a direction that `sample` finds, from a uniform point of a disk
/// perpendicular to it that touches the sphere around the scene and is as large.
template <class Model>
NORRSKEN_INLINE EmittedRay emit_from_afar(const SceneView& scene, const Light& light, Vec2f position, Vec2f direction,
                                          Mask active) {
  const Vec3f center = broadcast(scene.center);
  const LightSample seen = Model::sample(scene, light, center, direction, active);
  const Vec3f to_light = normalize(seen.point - center);
  const Vec2f disk = warp_to_disk(position);
  const Vec3f offset = make_frame(to_light).to_world({disk.x, disk.y, 1.0f});
  const Float area(kPi * scene.radius * scene.radius);
  return {fma(offset, Float(scene.radius), center), -to_light, seen.radiance * (area / seen.pdf_sa), seen.valid};
}

}  // namespace norrsken::NORRSKEN_ISA
