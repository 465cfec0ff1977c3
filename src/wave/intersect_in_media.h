// Stage: RAYS -> SCATTERS where a homogeneous medium stops them; else what intersect_closest writes, with what the media on
// the way have left of them; TRACKS for those that run through a grid.
// Stage: TRACKS -> the same, or TRACKS again for those that are still under way.
#pragma once

#include "light/light.h"
#include "wave/intersect_closest.h"
#include "wave/majorants.h"
#include "wave/medium_boundary.h"
#include "wave/scatter.h"

namespace norrsken::NORRSKEN_ISA {

/// What holds for all rays of one round.
struct RoundSettings {
  std::uint32_t hit_number, round;
  bool last;            ///< of these rays only emission counts
  bool hides_emitters;  ///< they are looked through
  std::uint32_t wanted_kinds;
};

/// Where rays go that have come to their ends, which are surfaces or nowhere.
inline void push_ends(const SceneView& scene, const RoundSettings& settings, const Hit& hit, FoundQueues& found,
                      Mask active) {
  const Mask alive = active & !(max_component(hit.ray.throughput) <= 0.0f);
  const Mask missed = alive & !(hit.t < kInfinity);
  if (scene.environment != kNone && any(missed)) push(scene, found.misses, hit.ray, missed);
  Mask met = alive & !missed;
  const Mask emits = met & ((hit.material & kEmitsBit) != 0u);
  if (any(emits)) push(scene, found.light_hits, hit, emits);
  if (settings.hides_emitters) met &= !emits;
  push_by_kind(scene, hit, settings.wanted_kinds, found.hits, met);
  if (!scene.any_resolved) return;
  const Mask unresolved = met & is_unresolved(hit.material);
  if (any(unresolved)) push(scene, found.unresolved_hits, hit, unresolved);
}

/// Counts the rays that come to a medium's boundary in another medium than the one that lies on that side of it.
inline void count_wrong_media(const SceneView& scene, const Hit& hit, UInt primitive_side, WaveCounts& counts,
                              Mask active) {
  const Mask outside = (primitive_side & kBackSide) == 0u;
  const UInt expected = medium_on_side(scene, hit.primitive, outside, hit.ray.medium, active);
  const Mask wrong = active & (expected != hit.ray.medium);
  if (none(wrong)) return;
  counts.wrong_media += count(wrong);
  alignas(64) float shapes[kLanes];
  store(shapes, shape_of(scene, hit.primitive, wrong));
  for (std::uint32_t rest = to_bits(wrong); rest != 0; rest &= rest - 1) {
    std::uint32_t shape;
    __builtin_memcpy(&shape, &shapes[__builtin_ctz(rest)], sizeof shape);
    if (shape < counts.wrong_medium_shape) counts.wrong_medium_shape = shape;
  }
}

inline void intersect_in_media(const SceneView& scene, const RoundSettings& settings, WaveMemory& memory,
                               WaveCounts& counts) {
  const Sampler sampler{scene.sampler.kind};
  const std::uint32_t dimension =
      first_dimension_of_round(settings.hit_number, settings.round) + hit_dimension::kDistance;
  const std::uint32_t phase_dimension = first_dimension_of_hit(settings.hit_number) + hit_dimension::kBsdfLobe;
  const bool from_camera = settings.hit_number == 1;
  const Rays& rays = memory.rays;
  ClosestOfQueue hits(scene, from_camera && settings.round == 0, rays);
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    Mask active = first_lanes(rays.count - i);
    Hit hit;
    hit.ray = load<Ray>(scene, rays, i);
    active = drop_invalid(is_valid(hit.ray), hit.ray.slot, memory.slots, active);
    const ClosestHit closest = hits.at(i, hit.ray.origin, hit.ray.direction, active);
    Mask missed = !(closest.t < kInfinity);
    if (from_camera)
      missed |= !(closest.t + hit.ray.travelled <= distance_to_far_plane(scene.camera, hit.ray.direction));
    set_end(hit, closest);
    hit.t = select(missed, kInfinity, hit.t);
    const Mask met = active & !missed;
    hit.material = material_of(scene, hit, closest.primitive_side, met);
    count_wrong_media(scene, hit, closest.primitive_side, counts, met);

    const Mask in_medium = active & is_in_some(hit.ray.medium);
    if (any(in_medium)) {
      const SampleKey key = load_sample_key(memory.slots, hit.ray.slot, in_medium);
      const Float u = sampler.sample_1d(key, dimension);
      const Mask in_grid = is_grid(scene, hit.ray.medium, in_medium);
      if (any(in_grid)) {
        push(scene, memory.media.tracks,
             Track{.hit = hit, .t = 0.0f, .depth = collision_depth(u), .cell = kNone, .drawn = 0u}, in_grid);
        active &= !in_grid;
      }
      const Mask homogeneous = in_medium & !in_grid;
      if (any(homogeneous)) {
        // A medium that nothing closes goes as far as lights around the scene are away.
        const Float to_lights_around = max(distance_to_lights_around(scene) - hit.ray.travelled, 0.0f);
        const Float distance = select(missed, to_lights_around, hit.t);
        const Flight flight = fly(scene, hit.ray.medium, hit.ray, distance, !settings.last, u, homogeneous);
        hit.ray.throughput = select(homogeneous, flight.throughput, hit.ray.throughput);
        if (any(flight.scattered)) {
          Ray stopped = hit.ray;
          stopped.origin = fma(hit.ray.direction, flight.t, hit.ray.origin);
          push_scatters(scene, stopped, sampler.sample_1d(key, phase_dimension), memory.media.scatters,
                        flight.scattered);
          active &= !flight.scattered;
        }
      }
    }
    push_ends(scene, settings, hit, memory.found, active);
  }
}

/// Steps that a lane takes before finished ones make room.
inline constexpr int kStepsAtATime = 8;

/// A word that the random numbers of a walk follow from.
NORRSKEN_INLINE UInt walk_key(const SampleKey& key, std::uint32_t dimension) {
  return hash(hash(key.key, key.index), UInt(dimension));
}

inline void track_media(const SceneView& scene, const RoundSettings& settings, WaveMemory& memory) {
  const std::uint32_t dimension =
      first_dimension_of_round(settings.hit_number, settings.round) + hit_dimension::kDistance;
  MediaQueues& media = memory.media;
  for (std::uint32_t i = 0; i < media.tracks.count; i += kLanes) {
    Mask active = first_lanes(media.tracks.count - i);
    Track track = load<Track>(scene, media.tracks, i);
    Hit& hit = track.hit;
    Ray& ray = hit.ray;
    const UInt key = walk_key(load_sample_key(memory.slots, ray.slot, active), dimension);
    const MajorantGrid grid(scene, ray.medium, ray.origin, ray.direction, active);
    const UInt scatters = gather_medium(scene, &MediumRecord::scatters, ray.medium, active);
    const Mask may_scatter = settings.last ? Mask::none() : active & (scatters != 0u);
    Walk walk{track.t, track.depth, track.cell, track.drawn};
    Mask ended = Mask::none(), scattered = Mask::none();
    for (int step = 0; step < kStepsAtATime && any(active); ++step) {
      const Step s = take_step(scene, grid, hit.t, key, walk, active);
      ended |= s.ended;
      active &= !s.ended;
      if (none(s.collided)) continue;
      const Vec3f position = fma(ray.direction, walk.t, ray.origin);
      const Color sigma = extinction_at(scene, ray.medium, position, ray.direction, s.majorant, s.collided);
      const Color rest = grey(s.majorant) - sigma;
      const Mask may = s.collided & may_scatter & (max_component(sigma) > 0.0f);
      // Whether light is scattered here, each channel with its share. What is absorbed leaves the throughput.
      Color scatter = black();
      if (any(may)) scatter = select(may, sigma * albedo_of(scene, ray.medium, position, may), scatter);
      const Color share = shares(ray.throughput);
      const Float of_scattering = sum_of_products(share, scatter),
                  of_all = of_scattering + sum_of_products(share, rest);
      const Mask stops = may & (draw(key, walk, may) * of_all < of_scattering);
      const Float prob = select(may, select(stops, of_scattering, of_all - of_scattering) / of_all, 1.0f);
      const Color weight = select(stops, scatter, rest) * (1.0f / (s.majorant * prob));
      ray.throughput = select(s.collided, ray.throughput * weight, ray.throughput);
      scattered |= stops;
      // Nothing is left of a ray that was absorbed in every channel.
      active &= !(stops | (s.collided & (max_component(ray.throughput) <= 0.0f)));
    }
    if (any(scattered)) {
      Ray stopped = ray;
      stopped.origin = fma(ray.direction, walk.t, ray.origin);
      const Float number = draw(key, walk, scattered);
      push_scatters(scene, stopped, number, media.scatters, scattered);
    }
    if (any(ended)) push_ends(scene, settings, hit, memory.found, ended);
    if (any(active)) {
      push(scene, media.next_tracks,
           Track{.hit = hit, .t = walk.t, .depth = walk.depth, .cell = walk.cell, .drawn = walk.drawn}, active);
    }
  }
}

}  // namespace norrsken::NORRSKEN_ISA
