// Stage: HITS of what light passes straight through -> PASSED rays, and the paths' next RAYS where it reflects.
#pragma once

#include "sampler/sampler.h"
#include "wave/intersect_in_media.h"
#include "wave/shade_surface.h"

namespace norrsken::NORRSKEN_ISA {

/// Models that light passes straight through, or is reflected by.
template <class Model>
concept PassesStraightOn = requires(typename Model::Parameters p, Vec3f w) {
  Model::straight_on(p, w);
};

inline constexpr std::uint32_t kPassedStraightOn = 0u
#define NORRSKEN_BSDF(kind, Model) | (PassesStraightOn<Model> ? 1u << static_cast<std::uint32_t>(BsdfKind::kind) : 0u)
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
    ;

/// The ray behind a surface that it passes, still unscattered.
NORRSKEN_INLINE Ray behind(const SceneView& scene, const Hit& hit, const SurfacePoint& surface, Mask active) {
  const Float side = dot(hit.ray.direction, surface.normal);
  Ray ray = hit.ray;
  ray.origin = spawn_origin(surface.position, surface.normal, surface.offset, side);
  ray.medium = medium_beyond(scene, hit.primitive, side, hit.ray.medium, active);
  ray.travelled = hit.ray.travelled + hit.t;
  return ray;
}

/// `settings` are those of the hit, `round` the one of the rays that hit.
template <class Model>
inline void pass_straight_on(const SceneView& scene, const ShadeSettings& settings, std::uint32_t round,
                             const Hits& hits, const Slots& slots, Rays& passed, Rays& next_rays) {
  const Sampler sampler{scene.sampler.kind};
  const std::uint32_t dimension = first_dimension_of_round(settings.hit_number, round);
  for (std::uint32_t i = 0; i < hits.count; i += kLanes) {
    const Mask active = first_lanes(hits.count - i);
    const Hit hit = load<Hit>(scene, hits, i);
    SurfacePoint surface = make_surface_point(scene, hit, active);
    const Perturbation map = perturb_frame(scene, hit, surface, active);
    const auto bsdf = Model::load(parameter_reader(scene, hit, surface, active));
    const Vec3f wo = surface.frame.to_local(-hit.ray.direction);
    const SampleKey key = load_sample_key(slots, hit.ray.slot, active);
    const BsdfSample sample = sample_bsdf<Model>(sampler, key, dimension, bsdf, wo);
    const Mask passes = active & sample.valid & (sample.wi.z < 0.0f);
    Ray ray = behind(scene, hit, surface, passes);
    ray.throughput = hit.ray.throughput * sample.weight;
    const Mask goes_on = passes & !(max_component(ray.throughput) <= 0.0f);
    if (any(goes_on)) push(scene, passed, ray, goes_on);

    Mask reflects = active & sample.valid & !(sample.wi.z < 0.0f);
    if (!settings.next_rays || none(reflects)) continue;
    const Vec3f direction = surface.frame.to_world(sample.wi);
    Color throughput = hit.ray.throughput * sample.weight;
    if (map.count > 0) throughput = throughput * map.weight(direction, sample.wi.z);
    reflects &= !(max_component(throughput) <= 0.0f);
    if (settings.roulette) {
      const Float survive = survival_probability(throughput, hit.ray.eta2);
      reflects &= sampler.sample_1d(key, dimension + hit_dimension::kRoulette) < survive;
      throughput = throughput * (1.0f / survive);
    }
    if (none(reflects)) continue;
    const Float side = dot(direction, surface.normal);
    push(scene, next_rays,
         Ray{.origin = spawn_origin(surface.position, surface.normal, surface.offset, side),
             .direction = direction,
             .throughput = throughput,
             .pdf_sa = 0.0f,
             .slot = hit.ray.slot,
             .eta2 = hit.ray.eta2,
             .medium = medium_beyond(scene, hit.primitive, side, hit.ray.medium, reflects)},
         reflects);
  }
}

/// Rays that come to emitters which the camera is not to see go on behind them.
inline void pass_hidden_emitters(const SceneView& scene, const Hits& light_hits, Rays& passed) {
  for (std::uint32_t i = 0; i < light_hits.count; i += kLanes) {
    const Mask active = first_lanes(light_hits.count - i);
    const Hit hit = load<Hit>(scene, light_hits, i);
    push(scene, passed, behind(scene, hit, make_surface_point(scene, hit, active), active), active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
