// Rays against the scene, whichever way the scene is held. The choice is one for the whole scene.
#pragma once

#include "accel/embree.h"
#include "accel/moller_trumbore.h"
#include "accel/planes.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE const float* corner(const SceneView& scene, std::uint32_t triangle, std::uint32_t k) {
  return scene.positions + std::size_t{3} * scene.triangle_vertices[std::size_t{3} * triangle + k];
}

NORRSKEN_INLINE TriangleCrossing cross_triangle_of(const SceneView& scene, std::uint32_t i, const Vec3f& o,
                                                   const Vec3f& d) {
  return cross_triangle(corner(scene, i, 0), corner(scene, i, 1), corner(scene, i, 2), o, d);
}

NORRSKEN_INLINE void closest_by_moller_trumbore(const SceneView& scene, const Vec3f& o, const Vec3f& d,
                                                ClosestHit& hit) {
  for (std::uint32_t i = 0; i < scene.triangle_count; ++i) {
    const TriangleCrossing c = cross_triangle_of(scene, i, o, d);
    const Mask found = c.inside & (c.t > Float(0.0f)) & (c.t < hit.t);
    const UInt side = select(c.back, UInt(kBackSide), UInt(0u));
    hit.t = select(found, c.t, hit.t);
    hit.primitive_side = select(found, side | UInt(i), hit.primitive_side);
  }
  for (std::uint32_t i = 0; i < scene.accel.sphere_count; ++i) closest_sphere(scene.accel.spheres[i], o, d, hit);
}

NORRSKEN_INLINE Mask occluded_by_moller_trumbore(const SceneView& scene, const Vec3f& o, const Vec3f& d, Float t_max) {
  Mask occluded = Float(1.0f) < Float(0.0f);
  for (std::uint32_t i = 0; i < scene.triangle_count; ++i) {
    const TriangleCrossing c = cross_triangle_of(scene, i, o, d);
    occluded |= c.inside & (c.t > Float(0.0f)) & (c.t < t_max);
  }
  for (std::uint32_t i = 0; i < scene.accel.sphere_count; ++i) {
    occluded |= occluded_by_sphere(scene.accel.spheres[i], o, d, t_max);
  }
  return occluded;
}

/// The closest hit of unit-length rays; `t` is infinite where there is none.
NORRSKEN_INLINE ClosestHit intersect_closest_lanes(const SceneView& scene, bool coherent, const Vec3f& o,
                                                   const Vec3f& d, Mask active) {
  ClosestHit hit = no_hit();
  switch (scene.accel.kind) {
    case AccelKind::planes:
      closest_in_planes(scene.accel, scene.accel.all, scene.accel.sphere_count, o, d, hit);
      break;
    case AccelKind::moller_trumbore:
      closest_by_moller_trumbore(scene, o, d, hit);
      break;
    case AccelKind::embree:
      return closest_in_embree(scene, coherent, copied(o), copied(d), active);
  }
  return hit;
}

/// Whether anything lies between the origin and `t_max`.
NORRSKEN_INLINE Mask occluded_lanes(const SceneView& scene, const Vec3f& o, const Vec3f& d, Float t_max, Mask active) {
  switch (scene.accel.kind) {
    case AccelKind::planes:
      return active & occluded_in_planes(scene.accel, o, d, t_max);
    case AccelKind::moller_trumbore:
      return active & occluded_by_moller_trumbore(scene, o, d, t_max);
    case AccelKind::embree:
      return occluded_in_embree(scene, copied(o), copied(d), t_max, active);
  }
  return active;
}

}  // namespace norrsken::NORRSKEN_ISA
