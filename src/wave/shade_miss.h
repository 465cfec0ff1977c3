// Stage: MISSES -> radiance of their slots: what the environment sends along rays that meet nothing.
#pragma once

#include "wave/mis.h"

namespace norrsken::NORRSKEN_ISA {

inline void shade_miss(const SceneView& scene, const Rays& misses, Slots& slots) {
  for (std::uint32_t i = 0; i < misses.count; i += kLanes) {
    const Mask active = first_lanes(misses.count - i);
    const Ray ray = load<Ray>(scene, misses, i);
    const Color radiance = environment_radiance(scene, copied(ray.direction), active);
    const Float weight = weight_of_found(scene, UInt(scene.environment), ray, Float(2.0f * scene.radius), active);
    add_radiance(slots, ray.slot, ray.throughput * radiance * weight, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
