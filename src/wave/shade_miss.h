// Stage: MISSES -> radiance of their slots: what the environment sends along rays that meet nothing.
#pragma once

#include "wave/mis.h"

namespace norrsken::NORRSKEN_ISA {

inline void shade_miss(const SceneView& scene, const Rays& misses, Slots& slots) {
  for (std::uint32_t i = 0; i < misses.count; i += kLanes) {
    const Mask active = first_lanes(misses.count - i);
    const Ray ray = load<Ray>(scene, misses, i);
    const SeenLight seen = environment_seen(scene, copied(ray.direction), active);
    Float weight(1.0f);
    const Mask both = competed(ray, active);
    if (any(both)) {
      const Float share = light_share(scene, UInt(scene.environment), light_reference(scene, ray), both);
      weight = weight_of_found(scene, ray, seen.pdf_sa * share, both);
    }
    add_radiance(slots, ray.slot, ray.throughput * seen.radiance * weight, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
