// Stage: LIGHT HITS -> radiance of their slots.
#pragma once

#include "wave/mis.h"
#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

inline void shade_emission(const SceneView& scene, const Queue& light_hits, Queue& slots) {
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
        emission = select(textured, evaluate_texture(scene, texture, copied(surface.texture), textured), emission);
      }
    }
    const Float weight = weight_of_found(scene, light, hit.ray, hit.t, active);
    add_radiance(slots, hit.ray.slot, hit.ray.throughput * emission * weight, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
