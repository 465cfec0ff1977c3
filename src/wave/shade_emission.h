// Stage: LIGHT HITS -> radiance of their slots.
#pragma once

#include "light/sample_lights.h"
#include "wave/mis.h"
#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

inline void shade_emission(const SceneView& scene, const Queue& light_hits, Queue& slots) {
  const Float light_samples(static_cast<float>(scene.integrator.emitter_samples));
  const Float bsdf_samples(static_cast<float>(scene.integrator.bsdf_samples));
  for (std::uint32_t i = 0; i < light_hits.count; i += kLanes) {
    const Mask active = first_lanes(light_hits.count - i);
    const Hit hit = load_hit(scene, light_hits, i);
    const UInt light = light_of(scene, hit.primitive, active);
    const auto* base = reinterpret_cast<const float*>(scene.lights);
    Vec3f emission = gather3(base + kLightEmission, light * UInt(kLightFloats), active);
    if (scene.texture_kinds != 0) {
      const UInt parameters = gather_uint(base + kLightParameters, light * UInt(kLightFloats), active);
      const UInt texture = light_texture(scene, parameters, active);
      const Mask textured = active & (texture != UInt(0u));
      if (any(textured)) {
        const SurfacePoint surface = make_surface_point(scene, hit, textured);
        emission = select(textured, evaluate_texture(scene, texture, surface.texture, textured), emission);
      }
    }

    Float weight(1.0f);
    const Mask competed = active & (hit.ray.pdf_sa > Float(0.0f));
    if (any(competed)) {
      const Float light_pdf = light_pdf_sa(scene, light, hit.ray.origin, hit.ray.direction, hit.t, competed);
      weight = select(competed, power_heuristic(bsdf_samples, hit.ray.pdf_sa, light_samples, light_pdf), weight);
    }
    add_radiance(slots, hit.ray.slot, hit.ray.throughput * emission * weight, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
