// Stage: SHADOW RAYS -> radiance of the slots whose ray reached its light, with what media and the surfaces that light
// passes straight through have left of it. In rounds: each brings a ray to the next surface.
#pragma once

#include "wave/intersect_in_media.h"
#include "wave/pass_straight_on.h"
#include "wave/resolve_materials.h"

namespace norrsken::NORRSKEN_ISA {

/// The share of light that passes the surface, for lanes of one model.
template <class Model>
NORRSKEN_INLINE void add_straight_on(const SceneView& scene, BsdfKind kind, const Hit& hit, const SurfacePoint& surface,
                                     Color& share, Mask active) {
  if constexpr (PassesStraightOn<Model>) {
    if ((scene.bsdf_kinds >> static_cast<std::uint32_t>(kind) & 1u) == 0) return;
    const Mask of_kind = active & ((hit.material & kMaterialKindMask) == UInt(make_material(kind, 0)));
    if (none(of_kind)) return;
    const auto bsdf = Model::load(parameter_reader(scene, hit, surface, of_kind));
    share = select(of_kind, Model::straight_on(bsdf, surface.frame.to_local(-hit.ray.direction)), share);
  }
}

/// The same whatever the material is; what stands before several models is one of them, by chance.
__attribute__((noinline)) inline Color share_straight_on(const SceneView& scene, Hit hit, SurfacePoint surface,
                                                         Float chance, Mask active) {
  if (scene.any_resolved) {
    Choice choice = Choice::by_chance(chance);
    MappedFrame frame = unmapped_frame(surface);
    const auto unresolved = [&] { return active & is_unresolved(hit.material); };
    for (Mask open = unresolved(); any(open); open = unresolved())
      look_behind(scene, surface, hit, frame, choice, open);
  }
  Color share = black();
#define NORRSKEN_BSDF(kind, Model) add_straight_on<Model>(scene, BsdfKind::kind, hit, surface, share, active);
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
  return share;
}

/// Rays whose transmittance up to their origin is known: on to the next round, or to their light.
NORRSKEN_INLINE void send_on(const SceneView& scene, const ShadowRay& ray, WaveMemory& memory, Mask active) {
  const Mask alive = active & (max_component(ray.contribution) != 0.0f);
  const Mask arrived = alive & !(ray.t_max > 0.0f), on = alive & !arrived;
  if (any(arrived)) add_radiance(memory.slots, ray.slot, ray.contribution, arrived);
  if (any(on)) push(scene, memory.media.next_shadow_rays, ray, on);
}

/// What holds for all shadow rays of one round.
struct ShadowRound {
  std::uint32_t dimension;     ///< the first
  std::uint32_t light_sample;  ///< of the emitter_samples of a vertex, each of which draws numbers of its own

  NORRSKEN_INLINE SampleKey key(const SceneView& scene, const Slots& slots, UInt slot, Mask active) const {
    const auto n = static_cast<std::uint32_t>(scene.integrator.emitter_samples);
    return Sampler{scene.sampler.kind}.repetition(load_sample_key(slots, slot, active), light_sample, n);
  }
};

inline void intersect_shadow_round(const SceneView& scene, const ShadowRound& round, WaveMemory& memory) {
  const Sampler sampler{scene.sampler.kind};
  const ShadowRays& rays = memory.shadow_rays;
  ClosestOfQueue hits(scene, false, RayFields(rays), rays.count);
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    ShadowRay ray = load<ShadowRay>(scene, rays, i);
    Mask active = drop_invalid(is_ray(ray.origin, ray.direction), ray.slot, memory.slots, first_lanes(rays.count - i));
    const ClosestHit closest = hits.at(i, ray.origin, ray.direction, active);
    const Mask met = active & (closest.t < ray.t_max);
    const Vec3f from = ray.origin;
    const UInt medium = ray.medium;
    const Float length = min(closest.t, ray.t_max);
    const SampleKey key = round.key(scene, memory.slots, ray.slot, active);
    if (any(met)) {
      Hit hit;
      hit.ray = Ray{.origin = ray.origin,
                    .direction = ray.direction,
                    .throughput = white(),
                    .pdf_sa = 0.0f,
                    .slot = ray.slot,
                    .medium = ray.medium};
      set_end(hit, closest);
      hit.material = material_of(scene, hit, closest.primitive_side, met);
      const UInt kind = hit.material & kMaterialKindMask;
      Mask may_pass = is_unresolved(hit.material);
      for (std::uint32_t kinds = kPassedStraightOn; kinds != 0; kinds &= kinds - 1)
        may_pass |= kind == UInt(static_cast<std::uint32_t>(__builtin_ctz(kinds)) << 24);
      may_pass &= met;
      active &= (!met) | may_pass;
      if (any(may_pass)) {
        const SurfacePoint surface = make_surface_point(scene, hit, may_pass);
        const Float chance = sampler.sample_1d(key, round.dimension + hit_dimension::kMaterial);
        const Color share = share_straight_on(scene, hit, copied(surface), chance, may_pass);
        const Ray passed = behind(scene, hit, surface, may_pass);
        ray.contribution = select(may_pass, ray.contribution * share, ray.contribution);
        ray.origin = select(may_pass, passed.origin, ray.origin);
        ray.medium = select(may_pass, passed.medium, ray.medium);
        ray.t_max = select(may_pass, max(ray.t_max - dot(passed.origin - from, ray.direction), 0.0f), ray.t_max);
      }
    }
    // Without a surface on the way the ray arrives, once its transmittance is known.
    ray.t_max = select(met, ray.t_max, 0.0f);
    active &= max_component(ray.contribution) != 0.0f;
    const Mask in_medium = active & is_in_some(medium);
    const Mask in_grid = is_grid(scene, medium, in_medium), homogeneous = in_medium & !in_grid;
    if (any(homogeneous)) {
      const Color sigma_t = gather_medium_color(scene, &MediumRecord::sigma_t, medium, homogeneous);
      ray.contribution = select(homogeneous, ray.contribution * transmittance(sigma_t, length), ray.contribution);
    }
    if (any(in_grid)) {
      const Float u = sampler.sample_1d(key, round.dimension + hit_dimension::kDistance);
      push(scene, memory.media.shadow_tracks,
           ShadowTrack{.ray = ray,
                       .from = from,
                       .medium = medium,
                       .length = length,
                       .t = 0.0f,
                       .depth = collision_depth(u),
                       .cell = kNone,
                       .drawn = 0u,
                       .kept = 1.0f},
           in_grid);
      active &= !in_grid;
    }
    send_on(scene, ray, memory, active);
  }
}

/// Ratio tracking (Novak, Selle, Jarosz, "Residual Ratio Tracking for Estimating Attenuation in Participating Media", 2014),
/// with roulette where little is left.
inline void track_shadows(const SceneView& scene, const ShadowRound& round, WaveMemory& memory) {
  MediaQueues& media = memory.media;
  for (std::uint32_t i = 0; i < media.shadow_tracks.count; i += kLanes) {
    Mask active = first_lanes(media.shadow_tracks.count - i);
    ShadowTrack track = load<ShadowTrack>(scene, media.shadow_tracks, i);
    ShadowRay& ray = track.ray;
    const UInt key = walk_key(round.key(scene, memory.slots, ray.slot, active), round.dimension);
    const MajorantGrid grid(scene, track.medium, track.from, ray.direction, active);
    Walk walk{track.t, track.depth, track.cell, track.drawn};
    Mask ended = Mask::none();
    for (int step = 0; step < kStepsAtATime && any(active); ++step) {
      const Step s = take_step(scene, grid, track.length, key, walk, active);
      ended |= s.ended;
      active &= !s.ended;
      if (none(s.collided)) continue;
      const Vec3f position = fma(ray.direction, walk.t, track.from);
      const Color sigma = extinction_at(scene, track.medium, position, ray.direction, s.majorant, s.collided);
      const Color passes = (grey(s.majorant) - sigma) * (1.0f / s.majorant);
      ray.contribution = select(s.collided, ray.contribution * passes, ray.contribution);
      track.kept = select(s.collided, track.kept * max_component(passes), track.kept);
      const Mask little = s.collided & (track.kept < 0.1f);
      if (any(little)) {
        const Mask survives = draw(key, walk, little) < track.kept;
        const Float inverse = 1.0f / select(little, track.kept, 1.0f);
        ray.contribution = select(little, ray.contribution * inverse, ray.contribution);
        track.kept = select(little, 1.0f, track.kept);
        active &= !(little & !survives);
      }
    }
    send_on(scene, ray, memory, ended);
    if (none(active)) continue;
    track.t = walk.t, track.depth = walk.depth, track.cell = walk.cell, track.drawn = walk.drawn;
    push(scene, media.next_shadow_tracks, track, active);
  }
}

/// The rays are those of one light sample of each vertex.
inline void intersect_shadow_through(const SceneView& scene, std::uint32_t hit_number, std::uint32_t light_sample,
                                     WaveMemory& memory) {
  MediaQueues& media = memory.media;
  for (std::uint32_t i = 0; memory.shadow_rays.count > 0 && i < kMostRounds; ++i) {
    const ShadowRound round{first_dimension_of_round(hit_number, kShadowRounds + i), light_sample};
    media.next_shadow_rays.count = media.shadow_tracks.count = 0;
    intersect_shadow_round(scene, round, memory);
    while (media.shadow_tracks.count > 0) {
      media.next_shadow_tracks.count = 0;
      track_shadows(scene, round, memory);
      std::swap(media.shadow_tracks, media.next_shadow_tracks);
    }
    std::swap(memory.shadow_rays, media.next_shadow_rays);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
