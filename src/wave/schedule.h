// The life of a wave, top to bottom: stages over queues, once per bounce.
//
//   camera samples -> generate_camera_rays -> RAYS <-----------------------------+
//                                              |                                 |
//                              intersect_closest (last: _emitters)               |
//                    |           |                            |                  |
//                  MISSES   LIGHT HITS   HITS by BSDF kind <- resolve_materials  |
//                    |           |                            |                  |
//               shade_miss  shade_emission              shade_surface ---> next rays
//                    |           |                            |
//                    +-------> SLOTS <--- intersect_shadow <--+ SHADOW RAYS
#pragma once

#include <utility>

#include "bsdf/models.h"
#include "wave/accumulate_film.h"
#include "wave/generate_camera_rays.h"
#include "wave/intersect_closest.h"
#include "wave/intersect_distance.h"
#include "wave/intersect_shadow.h"
#include "wave/intersect_shadow_through.h"
#include "wave/resolve_materials.h"
#include "wave/shade_emission.h"
#include "wave/shade_features.h"
#include "wave/shade_miss.h"
#include "wave/shade_surface.h"
#include "wave/skip_emitters.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr std::uint32_t kAllScattering = ~1u;  // every BSDF kind but absorb
/// The BSDF kinds that light sampling finds something of.
inline constexpr std::uint32_t kSampledByLights = 0u
#define NORRSKEN_BSDF(kind, Model) | (Model::kDelta ? 0u : 1u << static_cast<std::uint32_t>(BsdfKind::kind))
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
    ;

/// Shades the hits of one kind and traces their shadow rays, in portions that fit the shadow queue: portions of the
/// hits, and of the light samples per hit where those are many.
template <class Model>
inline void shade_kind(const SceneView& scene, ShadeSettings settings, const Hits& hits, WaveMemory& memory,
                       WaveCounts& counts) {
  const auto light_samples = settings.lights ? static_cast<std::uint32_t>(scene.integrator.emitter_samples) : 0u;
  // Through media, those of each light sample draw numbers of their own.
  const std::uint32_t most = scene.volumetric ? 1 : memory.shadow_rays.capacity() / kMaxLanes;
  const std::uint32_t per_pass = light_samples < most ? light_samples : most;
  const std::uint32_t portion = memory.shadow_rays.capacity() / (per_pass > 0 ? per_pass : 1) / kMaxLanes * kMaxLanes;
  const bool next_rays = settings.next_rays;
  for (std::uint32_t begin = 0; begin < hits.count; begin += portion) {
    const std::uint32_t end = hits.count - begin < portion ? hits.count : begin + portion;
    for (std::uint32_t first = 0; first == 0 || first < light_samples; first += per_pass) {
      settings.first_light_sample = first;
      settings.end_light_sample = light_samples - first < per_pass ? light_samples : first + per_pass;
      settings.next_rays = next_rays && first == 0;
      memory.shadow_rays.count = 0;
      shade_surface<Model>(scene, settings, hits, begin, end, memory.slots, memory.shadow_rays, memory.next_rays);
      counts.shadow_rays += memory.shadow_rays.count;
      memory.tell(WaveEvent::shadow_rays);
      if (scene.volumetric) {
        intersect_shadow_through(scene, settings.hit_number, first, memory);
      } else {
        intersect_shadow(scene, memory.shadow_rays, memory.slots);
      }
      if (Model::kDelta || per_pass == 0) break;  // nothing was sampled
    }
  }
}

/// Dispatches on the kind, one queue after the other.
inline void shade_surfaces(const SceneView& scene, const ShadeSettings& settings, WaveMemory& memory,
                           WaveCounts& counts) {
#define NORRSKEN_BSDF(kind, Model) \
  shade_kind<Model>(scene, settings, memory.found.hits[static_cast<std::uint32_t>(BsdfKind::kind)], memory, counts);
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
}

NORRSKEN_INLINE void clear(Hits (&hits)[kModelCount]) {
  for (Hits& of_kind : hits) of_kind.count = 0;
}

NORRSKEN_INLINE void clear(FoundQueues& found) {
  clear(found.hits);
  found.unresolved_hits.count = found.light_hits.count = found.misses.count = 0;
}

/// The emission that a path's last rays find, in memory.rays.
inline void finish_paths(const SceneView& scene, WaveMemory& memory, WaveCounts& counts) {
  counts.closest_rays += memory.rays.count;
  memory.found.light_hits.count = memory.found.misses.count = 0;
  intersect_emitters(scene, memory.rays, memory.slots, memory.found);
  shade_emission(scene, memory.found.light_hits, memory.slots);
  shade_miss(scene, memory.found.misses, memory.slots);
  memory.tell(WaveEvent::emission);
}

/// Directions of the first hits beyond the first one; the next rays of that stay where they are.
inline void sample_further_directions(const SceneView& scene, ShadeSettings settings, WaveMemory& memory,
                                      WaveCounts& counts) {
  const auto n = static_cast<std::uint32_t>(scene.integrator.bsdf_samples);
  settings.lights = false;
  for (settings.bsdf_sample = 1; settings.bsdf_sample < n; ++settings.bsdf_sample) {
    // Meanwhile the first direction's next rays stand where the rays of this bounce did, which are done with.
    std::swap(memory.rays, memory.next_rays);
    memory.next_rays.count = 0;
    shade_surfaces(scene, settings, memory, counts);
    std::swap(memory.rays, memory.next_rays);
    finish_paths(scene, memory, counts);
  }
}

/// Shades what is in memory.found.hits, with all directions that are wanted of it.
inline void shade_hits(const SceneView& scene, const ShadeSettings& settings, WaveMemory& memory, WaveCounts& counts) {
  shade_surfaces(scene, settings, memory, counts);
  if (scene.integrator.bsdf_samples > 1 && settings.next_rays) {
    sample_further_directions(scene, settings, memory, counts);
  }
}

/// Shades the hits whose materials stand before several models. The path goes on by the model that chance picks, but the
/// lights are sampled for each: to leave that to chance would be the larger part of the noise.
inline void shade_all_behind(const SceneView& scene, ShadeSettings settings, WaveMemory& memory, WaveCounts& counts) {
  const bool next_rays = settings.next_rays;
  if (next_rays) {
    settings.lights = false;
    clear(memory.found.hits);
    resolve_materials(scene, first_dimension_of_hit(settings.hit_number), kByChance, kAllScattering,
                      memory.found.unresolved_hits, memory.slots, memory.found.hits);
    memory.tell(WaveEvent::resolved);
    shade_hits(scene, settings, memory, counts);
  }
  settings.lights = true;
  settings.next_rays = false;
  for (std::uint32_t code = 0; code < scene.material_codes; ++code) {
    clear(memory.found.hits);
    resolve_materials(scene, first_dimension_of_hit(settings.hit_number), code, kSampledByLights,
                      memory.found.unresolved_hits, memory.slots, memory.found.hits);
    shade_surfaces(scene, settings, memory, counts);
  }
}

/// Traces a wave's paths from camera to slots.
inline void trace_wave(const SceneView& scene, const WaveJob& job, WaveMemory& memory, WaveCounts& counts) {
  const IntegratorSettings& integrator = scene.integrator;
  const auto max_depth = integrator.max_depth < 0 ? 0xffffffffu : static_cast<std::uint32_t>(integrator.max_depth);
  generate_camera_rays(scene, job, memory.slots, memory.rays);
  memory.tell(WaveEvent::camera_rays);
  if (integrator.distance) {
    counts.closest_rays += memory.rays.count;
    intersect_distance(scene, memory.rays, memory.slots);
    return;
  }
  if (integrator.hide_emitters && scene.any_area_light) skip_emitters(scene, memory.rays);
  for (std::uint32_t hit_number = 1; hit_number <= max_depth && memory.rays.count > 0; ++hit_number) {
    const bool last = hit_number == max_depth;
    counts.closest_rays += memory.rays.count;
    clear(memory.found);
    memory.next_rays.count = 0;
    if (last && hit_number > 1) {
      intersect_emitters(scene, memory.rays, memory.slots, memory.found);
    } else {
      intersect_closest(scene, hit_number == 1, last ? 0u : kAllScattering, memory.rays, memory.slots, memory.found);
    }
    memory.tell(WaveEvent::intersected);
    if (!last && scene.material_codes == 1 && memory.found.unresolved_hits.count > 0) {
      resolve_materials(scene, first_dimension_of_hit(hit_number), kByChance, kAllScattering,
                        memory.found.unresolved_hits, memory.slots, memory.found.hits);
      memory.tell(WaveEvent::resolved);
    }
    if (!(integrator.hide_emitters && hit_number == 1)) {
      shade_emission(scene, memory.found.light_hits, memory.slots);
      shade_miss(scene, memory.found.misses, memory.slots);
      memory.tell(WaveEvent::emission);
    }
    if (last) break;
    // A path's last ray can only find an area light; without one there is no need to send it.
    const bool next_is_last = hit_number + 1 == max_depth;
    const bool anything_to_find = !next_is_last || scene.any_area_light || scene.environment != kNone;
    const ShadeSettings settings{.hit_number = hit_number,
                                 .next_rays = anything_to_find && integrator.bsdf_samples > 0,
                                 .roulette = hit_number >= static_cast<std::uint32_t>(integrator.rr_depth)};
    shade_hits(scene, settings, memory, counts);
    if (scene.material_codes > 1 && memory.found.unresolved_hits.count > 0)
      shade_all_behind(scene, settings, memory, counts);
    std::swap(memory.rays, memory.next_rays);
    memory.tell(WaveEvent::next_rays);
  }
}

/// The feature layers of a wave's first hits.
inline void trace_features(const SceneView& scene, const WaveJob& job, WaveMemory& memory, WaveCounts& counts) {
  generate_camera_rays(scene, job, memory.slots, memory.rays);
  if (scene.integrator.hide_emitters && scene.any_area_light) skip_emitters(scene, memory.rays);
  for (std::uint32_t k = 0; k < kFeatureCount; ++k) {
    float* feature = memory.slots.field(&stored::Slot::features, k);
    for (std::uint32_t i = 0; i < memory.slots.count; i += kLanes) store(feature + i, Float(0.0f));
  }
  clear(memory.found);
  counts.closest_rays += memory.rays.count;
  intersect_closest(scene, true, ~0u, memory.rays, memory.slots, memory.found);
  resolve_materials(scene, first_dimension_of_hit(1), kByChance, ~0u, memory.found.unresolved_hits, memory.slots,
                    memory.found.hits);
  shade_features<Absorb>(scene, memory.found.hits[0], memory.slots);
#define NORRSKEN_BSDF(kind, Model) \
  shade_features<Model>(scene, memory.found.hits[static_cast<std::uint32_t>(BsdfKind::kind)], memory.slots);
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
}

}  // namespace norrsken::NORRSKEN_ISA
