// Stage: RAYS from the camera -> the same, begun behind the surfaces of emitters that they would meet first.
#pragma once

#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

/// Emitters behind each other that are looked through: far more than any scene has, so that no ray goes on forever.
inline constexpr int kMostSkipped = 256;

/// The ray of a hit goes on behind what it met.
NORRSKEN_INLINE void step_behind(const SceneView& scene, Hit& hit, Mask active) {
  const SurfacePoint surface = make_surface_point(scene, hit, active);
  const Float side = dot(hit.ray.direction, surface.normal);
  const Vec3f behind = spawn_origin(surface.position, surface.normal, surface.offset, side);
  hit.ray.origin = select(active, behind, hit.ray.origin);
}

inline void skip_emitters(const SceneView& scene, Queue& rays) {
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    Mask active = first_lanes(rays.count - i);
    Hit hit;
    hit.ray = load_ray(scene, rays, i);
    for (int skipped = 0; skipped < kMostSkipped && any(active); ++skipped) {
      const ClosestHit closest =
          intersect_closest_lanes(scene, skipped == 0, hit.ray.origin, hit.ray.direction, active);
      active &= closest.t < Float(kInfinity);
      end_at(hit, closest);
      active &= is_emitter(scene, hit.primitive, active);
      if (none(active)) break;
      step_behind(scene, hit, active);
    }
    store(rays.field(kRayOriginX) + i, hit.ray.origin.x);
    store(rays.field(kRayOriginY) + i, hit.ray.origin.y);
    store(rays.field(kRayOriginZ) + i, hit.ray.origin.z);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
