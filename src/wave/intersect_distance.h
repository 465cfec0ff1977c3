// Stage: RAYS from the camera -> their slots get the distance to what they meet, 0 where that is nothing.
#pragma once

#include "accel/intersect.h"
#include "camera/camera.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

inline void intersect_distance(const SceneView& scene, const Rays& rays, Slots& slots) {
  ClosestOfQueue hits(scene, true, rays);
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    const Ray ray = load<Ray>(scene, rays, i);
    const Mask active = drop_invalid(is_valid(ray), ray.slot, slots, first_lanes(rays.count - i));
    const ClosestHit closest = hits.at(i, ray.origin, ray.direction, active);
    const Mask met = active & (closest.t <= distance_to_far_plane(scene.camera, ray.direction));
    const Float distance = closest.t + distance_to_near_plane(scene.camera, ray.direction);
    add_radiance(slots, ray.slot, grey(distance), met);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
