// The life of a wave of paths that start at the lights, top to bottom.
//
//   camera samples -> a path's first ray, of which only emission counts (trace_wave) -> SLOTS
//   light samples  -> generate_light_rays -> RAYS <-----------------------+
//                                             |                           |
//                                      intersect_closest                  |
//                                             |                           |
//                                    HITS by BSDF kind                    |
//                                             |                           |
//   SPLATS <- intersect_connections <- shade_particles ------------> next rays
//
// Light that reaches the camera straight from where it was emitted is seen by the camera's own rays, without noise;
// what was scattered at least once comes from the lights.
#pragma once

#include "wave/generate_light_rays.h"
#include "wave/intersect_connections.h"
#include "wave/schedule.h"
#include "wave/shade_particles.h"

namespace norrsken::NORRSKEN_ISA {

/// What the camera sees of the emitters themselves, in the slots.
inline void show_emitters(const SceneView& scene, const WaveJob& job, WaveMemory& memory, WaveCounts& counts) {
  SceneView seen = scene;
  const bool visible = !scene.integrator.hide_emitters && (scene.any_area_light || scene.environment != kNone);
  seen.integrator.max_depth = visible && scene.integrator.max_depth != 0 ? 1 : 0;
  trace_wave(seen, job, memory, counts);
}

template <class Model>
inline void shade_particles_of_kind(const SceneView& scene, const ParticleSettings& settings, const Hits& hits,
                                    WaveMemory& memory, WaveCounts& counts) {
  memory.connections.count = 0;
  shade_particles<Model>(scene, settings, hits, memory.slots, memory.connections, memory.next_rays);
  counts.shadow_rays += memory.connections.count;
  intersect_connections(scene, memory.connections, memory.splats);
}

/// Begins a wave at hit number 1. Returns 0 when the wave is done, else the hit number to go on with when the splats
/// have been taken to the film.
inline std::uint32_t trace_particles(const SceneView& scene, const WaveJob& job, std::uint32_t hit_number,
                                     WaveMemory& memory, WaveCounts& counts) {
  const IntegratorSettings& integrator = scene.integrator;
  const auto max_depth = integrator.max_depth < 0 ? 0xffffffffu : static_cast<std::uint32_t>(integrator.max_depth);
  memory.splats.count = 0;
  if (hit_number == 1) {
    show_emitters(scene, job, memory, counts);
    memory.rays.count = 0;
    if (scene.light_count > 0 && max_depth > 1) generate_light_rays(scene, job, memory.slots, memory.rays);
  }
  // What is connected after h hits has depth h + 1.
  for (; memory.rays.count > 0 && hit_number < max_depth; ++hit_number) {
    if (memory.splats.capacity() - memory.splats.count < memory.rays.count) return hit_number;
    counts.closest_rays += memory.rays.count;
    clear(memory.found);
    memory.next_rays.count = 0;
    intersect_closest(scene, false, kAllScattering, memory.rays, memory.slots, memory.found);
    resolve_materials(scene, first_dimension_of_hit(hit_number), kByChance, kAllScattering,
                      memory.found.unresolved_hits, memory.slots, memory.found.hits);
    const ParticleSettings settings{.hit_number = hit_number,
                                    .next_rays = hit_number + 1 < max_depth,
                                    .roulette = hit_number >= static_cast<std::uint32_t>(integrator.rr_depth)};
#define NORRSKEN_BSDF(kind, Model)                                                                               \
  shade_particles_of_kind<Model>(scene, settings, memory.found.hits[static_cast<std::uint32_t>(BsdfKind::kind)], \
                                 memory, counts);
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
    std::swap(memory.rays, memory.next_rays);
  }
  return 0;
}

}  // namespace norrsken::NORRSKEN_ISA
