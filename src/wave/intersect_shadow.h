// Stage: SHADOW RAYS -> radiance of the slots whose ray reached its light.
#pragma once

#include "accel/intersect.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

inline void intersect_shadow(const SceneView& scene, const ShadowRays& shadow_rays, Slots& slots) {
  OccludedOfQueue occluded(scene, shadow_rays);
  for (std::uint32_t i = 0; i < shadow_rays.count; i += kLanes) {
    const ShadowRay ray = load<ShadowRay>(scene, shadow_rays, i);
    const Mask active =
        drop_invalid(is_ray(ray.origin, ray.direction), ray.slot, slots, first_lanes(shadow_rays.count - i));
    const Mask visible = active & !occluded.at(i, ray.origin, ray.direction, ray.t_max, active);
    if (any(visible)) add_radiance(slots, ray.slot, ray.contribution, visible);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
