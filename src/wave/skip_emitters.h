// Stage: RAYS from the camera -> the same, begun behind the surfaces of emitters that they would meet first.
#pragma once

#include "wave/hits.h"

namespace norrsken::NORRSKEN_ISA {

/// Emitters behind each other that are looked through: far more than any scene has, so that no ray goes on forever.
inline constexpr int kMostSkipped = 256;

inline void skip_emitters(const SceneView& scene, Rays& rays) {
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    Mask active = first_lanes(rays.count - i);
    Hit hit;
    hit.ray = load<Ray>(scene, rays, i);
    for (int skipped = 0; skipped < kMostSkipped && any(active); ++skipped) {
      const ClosestHit closest =
          intersect_closest_lanes(scene, skipped == 0, hit.ray.origin, hit.ray.direction, active);
      active &= closest.t < kInfinity;
      set_end(hit, closest);
      active &= is_emitter(scene, hit.primitive, active);
      if (none(active)) break;
      step_behind(scene, hit, active);
    }
    store(rays.field(&stored::Ray::origin, 0) + i, hit.ray.origin.x);
    store(rays.field(&stored::Ray::origin, 1) + i, hit.ray.origin.y);
    store(rays.field(&stored::Ray::origin, 2) + i, hit.ray.origin.z);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
