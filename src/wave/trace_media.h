// The life of a wave in a scene with media, bounce by bounce. Rays pass the boundaries of media, and whatever else light
// passes straight through, in rounds within a bounce: none of that counts as scattering.
//
//   camera samples -> RAYS <------------------------------------------------------------------------+
//                      |   ^                                                                         |
//                      |   +--- PASSED <--- pass_straight_on <--+                                    |
//                      v                                        |                                    |
//          intersect_in_media -> MISSES, LIGHT HITS, HITS by BSDF kind ---> shade_surface --> next rays
//                  |    ^   |                                                            |           |
//                TRACKS |   +-> SCATTERS by phase function --------------> shade_scatters --> next rays
//                  |    |           ^                                                    |
//                track_media -------+                              SHADOW RAYS -> intersect_shadow_through -> SLOTS
#pragma once

#include "wave/schedule.h"
#include "wave/shade_scatters.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE void clear(Scatters (&scatters)[kPhaseModelCount]) {
  for (Scatters& of_kind : scatters) of_kind.count = 0;
}

/// Lets the rays of memory.rays pass until each has met a surface or is scattered; their emission is in the slots then,
/// the rest in memory.found.hits and memory.media.scatters.
inline void find_vertices(const SceneView& scene, const ShadeSettings& settings, bool last, WaveMemory& memory,
                          WaveCounts& counts) {
  MediaQueues& media = memory.media;
  FoundQueues& found = memory.found;
  const bool hides = scene.integrator.hide_emitters && settings.hit_number == 1;
  for (std::uint32_t round = 0; memory.rays.count > 0 && round < kMostRounds; ++round) {
    const RoundSettings of_round{settings.hit_number, round, last, hides, last ? kPassedStraightOn : kAllScattering};
    counts.closest_rays += memory.rays.count;
    found.light_hits.count = found.misses.count = found.unresolved_hits.count = 0;
    media.tracks.count = media.passed.count = 0;
    intersect_in_media(scene, of_round, memory, counts);
    while (media.tracks.count > 0) {
      media.next_tracks.count = 0;
      track_media(scene, of_round, memory);
      std::swap(media.tracks, media.next_tracks);
    }
    if (found.unresolved_hits.count > 0) {
      resolve_materials(scene, first_dimension_of_round(settings.hit_number, round), kByChance, of_round.wanted_kinds,
                        found.unresolved_hits, memory.slots, found.hits);
    }
    if (hides) {
      pass_hidden_emitters(scene, found.light_hits, media.passed);
    } else {
      shade_emission(scene, found.light_hits, memory.slots);
      shade_miss(scene, found.misses, memory.slots);
    }
#define NORRSKEN_BSDF(kind, Model)                                                                       \
  if constexpr (PassesStraightOn<Model>) {                                                               \
    Hits& hits = found.hits[static_cast<std::uint32_t>(BsdfKind::kind)];                                 \
    pass_straight_on<Model>(scene, settings, round, hits, memory.slots, media.passed, memory.next_rays); \
    hits.count = 0;                                                                                      \
  }
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
    std::swap(memory.rays, media.passed);
  }
}

/// Shades what is scattered by one phase function and traces its shadow rays, in portions that fit the shadow queue.
template <class Phase>
inline void shade_phase(const SceneView& scene, ShadeSettings settings, const Scatters& scatters, WaveMemory& memory,
                        WaveCounts& counts) {
  const auto light_samples = static_cast<std::uint32_t>(scene.integrator.emitter_samples);
  const bool next_rays = settings.next_rays;
  const std::uint32_t portion = memory.shadow_rays.capacity() / kMaxLanes * kMaxLanes;
  for (std::uint32_t begin = 0; begin < scatters.count; begin += portion) {
    const std::uint32_t end = scatters.count - begin < portion ? scatters.count : begin + portion;
    for (std::uint32_t sample = 0; sample < light_samples; ++sample) {
      settings.first_light_sample = sample, settings.end_light_sample = sample + 1;
      settings.next_rays = next_rays && sample == 0;
      memory.shadow_rays.count = 0;
      shade_scatters<Phase>(scene, settings, scatters, begin, end, memory.slots, memory.shadow_rays, memory.next_rays);
      counts.shadow_rays += memory.shadow_rays.count;
      intersect_shadow_through(scene, settings.hit_number, sample, memory);
    }
  }
}

inline void trace_media(const SceneView& scene, const WaveJob& job, WaveMemory& memory, WaveCounts& counts) {
  const IntegratorSettings& integrator = scene.integrator;
  const auto max_depth = integrator.max_depth < 0 ? 0xffffffffu : static_cast<std::uint32_t>(integrator.max_depth);
  generate_camera_rays(scene, job, memory.slots, memory.rays);
  for (std::uint32_t hit_number = 1; hit_number <= max_depth && memory.rays.count > 0; ++hit_number) {
    const bool last = hit_number == max_depth;
    clear(memory.found);
    clear(memory.media.scatters);
    memory.next_rays.count = 0;
    const bool next_is_last = hit_number + 1 == max_depth;
    const bool anything_to_find = !next_is_last || scene.any_area_light || scene.environment != kNone;
    const ShadeSettings settings{.hit_number = hit_number,
                                 .next_rays = anything_to_find && !last,
                                 .roulette = hit_number >= static_cast<std::uint32_t>(integrator.rr_depth)};
    find_vertices(scene, settings, last, memory, counts);
    if (last) break;
    shade_surfaces(scene, settings, memory, counts);
#define NORRSKEN_PHASE(kind, Model)                                                                               \
  shade_phase<Model>(scene, settings, memory.media.scatters[static_cast<std::uint32_t>(PhaseKind::kind)], memory, \
                     counts);
#include "lists/phase.def"
#undef NORRSKEN_PHASE
    std::swap(memory.rays, memory.next_rays);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
