// Stage: LIGHT HITS -> radiance of their slots.
#pragma once

#include "wave/mis.h"
#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

inline void shade_emission(const SceneView& scene, const Hits& light_hits, Slots& slots) {
  for (std::uint32_t i = 0; i < light_hits.count; i += kLanes) {
    const Mask active = first_lanes(light_hits.count - i);
    const Hit hit = load<Hit>(scene, light_hits, i);
    const UInt light = light_of(scene, hit.primitive, active);
    Color emission = gather_emission(scene.lights, light, active);
    if (scene.texture_kinds != 0) {
      const UInt parameters = gather(scene.lights, &LightRecord::parameters, light, active);
      const UInt texture = light_texture(scene, parameters, active);
      const Mask textured = active & (texture != 0u);
      if (any(textured)) {
        const SurfacePoint surface = make_surface_point(scene, hit, textured);
        emission = select(textured, evaluate_texture(scene, texture, copied(surface.texture), textured), emission);
      }
    }
    Float weight(1.0f);
    const Mask both = competed(hit.ray, active);
    if (any(both)) {
      const Float distance = scene.volumetric ? hit.t + hit.ray.travelled : hit.t;
      const Float light_pdf = light_pdf_sa(scene, light, copied(light_reference(scene, hit.ray)),
                                           copied(hit.ray.direction), distance, both);
      weight = weight_of_found(scene, hit.ray, light_pdf, both);
    }
    add_radiance(slots, hit.ray.slot, hit.ray.throughput * emission * weight, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
