// Stage: MISSES -> radiance of their slots: what the environment sends along rays that meet nothing.
#pragma once

#include "light/sample_lights.h"
#include "wave/mis.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

inline void shade_miss(const SceneView& scene, const Queue& misses, Queue& slots) {
  const Float light_samples(static_cast<float>(scene.integrator.emitter_samples));
  const Float bsdf_samples(static_cast<float>(scene.integrator.bsdf_samples));
  for (std::uint32_t i = 0; i < misses.count; i += kLanes) {
    const Mask active = first_lanes(misses.count - i);
    const Ray ray = load_ray(misses, i);
    const Vec3f radiance = environment_radiance(scene, ray.direction, active);
    Float weight(1.0f);
    const Mask competed = active & (ray.pdf_sa > Float(0.0f));
    if (any(competed)) {
      const Float light_pdf =
          light_pdf_sa(scene, UInt(scene.environment), ray.origin, ray.direction, Float(2.0f * scene.radius), competed);
      weight = select(competed, power_heuristic(bsdf_samples, ray.pdf_sa, light_samples, light_pdf), weight);
    }
    add_radiance(slots, ray.slot, ray.throughput * radiance * weight, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
