// Stage: HITS of one BSDF kind -> SHADOW RAYS to the lights, and the paths' next RAYS.
#pragma once

#include "light/sample_lights.h"
#include "wave/medium_boundary.h"
#include "wave/mis.h"
#include "wave/perturbed_frame.h"
#include "wave/plain_scene.h"
#include "wave/sample_bsdf.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// What holds for all hits of one bounce.
struct ShadeSettings {
  std::uint32_t hit_number;  ///< 1 for the camera's hits; the random dimensions of the bounce
  std::uint32_t first_light_sample = 0, end_light_sample = 0;  ///< which of the emitter_samples per hit to take
  bool next_rays;                                              ///< paths go on, if only to look for emission
  bool roulette;
  bool lights = true;             ///< sample them
  std::uint32_t bsdf_sample = 0;  ///< which of the bsdf_samples to take
};

/// Survival probability as Mitsuba's: the largest component of the throughput, at most 0.95. Where radiance is
/// compressed, in glass, it is taken as it will be again outside: `eta2` undoes what refraction did to the throughput.
NORRSKEN_INLINE Float survival_probability(const Color& throughput, Float eta2) {
  return min(max_component(throughput) * eta2, 0.95f);
}

/// By which lights are chosen.
template <class Model>
NORRSKEN_INLINE Receiver receiver_of(const typename Model::Parameters& bsdf, const Vec3f& normal) {
  Float least(kLeastFacing);
  if constexpr (requires { Model::transmits(bsdf); }) least = select(Model::transmits(bsdf), 1.0f, least);
  return {normal, least};
}

template <class Model, class Scene>
NORRSKEN_INLINE void sample_lights(const Scene& scene, const ShadeSettings& settings, const Sampler& sampler,
                                   const SampleKey& key, const Hit& hit, const SurfacePoint& surface,
                                   const Perturbation& map, const typename Model::Parameters& bsdf, const Vec3f& wo,
                                   ShadowRays& shadow_rays, Mask active) {
  const auto n = static_cast<std::uint32_t>(scene.integrator.emitter_samples);
  const std::uint32_t dimension = first_dimension_of_hit(settings.hit_number);
  const Float bsdf_samples(static_cast<float>(scene.integrator.bsdf_samples));
  const bool choose = scene.light_count > 1;
  const bool mis = scene.integrator.diffuse_bounces && scene.integrator.bsdf_samples > 0;
  for (std::uint32_t i = settings.first_light_sample; i < settings.end_light_sample; ++i) {
    const SampleKey k = sampler.repetition(key, i, n);
    Vec2f pick{0.0f, 0.0f};
    if (choose) pick = sampler.sample_2d(k, dimension + hit_dimension::kLight);
    const Vec2f u = sampler.sample_2d(k, dimension + hit_dimension::kLightPosition);
    const LightChoice light =
        sample_one_light(scene, surface.position, receiver_of<Model>(bsdf, surface.frame.n), pick, u, active);

    const Float side = dot(light.sample.point - surface.position, surface.normal);
    const Vec3f origin = spawn_origin(surface.position, surface.normal, surface.offset, side);
    const Vec3f to_light = light.sample.point - origin;
    const Float distance = sqrt(dot(to_light, to_light));
    const Vec3f direction = to_light * (1.0f / distance);
    const Vec3f wi = surface.frame.to_local(direction);

    const Color f = Model::evaluate(bsdf, wo, wi);
    Float weight = 1.0f / (light.prob * light.sample.pdf_sa * Float(static_cast<float>(n)));
    if (mis) {
      const Float competing = power_heuristic(Float(static_cast<float>(n)), light.weight_prob * light.sample.pdf_sa,
                                              bsdf_samples, Model::pdf_sa(bsdf, wo, wi));
      weight = weight * select(light.delta, 1.0f, competing);
    }
    if (map.count > 0) weight = weight * map.weight(direction, wi.z);
    const Color contribution = hit.ray.throughput * f * light.sample.radiance * weight;
    const Mask lit = active & light.sample.valid & (max_component(contribution) != 0.0f);
    if (none(lit)) continue;
    push(scene, shadow_rays,
         ShadowRay{.origin = origin,
                   .direction = direction,
                   .t_max = distance,
                   .contribution = contribution,
                   .slot = hit.ray.slot,
                   .medium = medium_beyond(scene, hit.primitive, side, hit.ray.medium, active)},
         lit);
  }
}

template <class Model, class Scene>
NORRSKEN_INLINE void sample_next_ray(const Scene& scene, const ShadeSettings& settings, const Sampler& sampler,
                                     const SampleKey& key, const Hit& hit, const SurfacePoint& surface,
                                     const Perturbation& map, const typename Model::Parameters& bsdf, const Vec3f& wo,
                                     Float path_eta2, Rays& next_rays, Mask active) {
  const std::uint32_t dimension = first_dimension_of_hit(settings.hit_number);
  const auto n = static_cast<std::uint32_t>(scene.integrator.bsdf_samples);
  const SampleKey k = sampler.repetition(key, settings.bsdf_sample, n);
  const BsdfSample sample = sample_bsdf<Model>(sampler, k, dimension, bsdf, wo);
  const Vec3f direction = surface.frame.to_world(sample.wi);
  Color throughput = hit.ray.throughput * sample.weight;
  if (map.count > 0) throughput = throughput * map.weight(direction, sample.wi.z);
  // A NaN passes on purpose: where the next ray is intersected its sample is made invalid, and counted.
  active &= sample.valid & !(max_component(throughput) <= 0.0f);
  if (n > 1) throughput = throughput * Float(1.0f / static_cast<float>(n));
  const Float eta2 = path_eta2 * (sample.eta * sample.eta);
  if (settings.roulette) {
    const Float survive = survival_probability(throughput, eta2);
    active &= sampler.sample_1d(key, dimension + hit_dimension::kRoulette) < survive;
    throughput = throughput * (1.0f / survive);
  }
  const Float side = dot(direction, surface.normal);
  const Vec3f origin = spawn_origin(surface.position, surface.normal, surface.offset, side);
  // Light sampling competes with a direction unless it is a delta or nothing can be sampled.
  const bool competed = scene.light_count > 0 && scene.integrator.emitter_samples > 0;
  const Float pdf = competed ? sample.pdf_sa : 0.0f;
  if (none(active)) return;
  push(scene, next_rays,
       Ray{.origin = origin,
           .direction = direction,
           .throughput = throughput,
           .pdf_sa = pdf,
           .slot = hit.ray.slot,
           .eta2 = eta2,
           .medium = medium_beyond(scene, hit.primitive, side, hit.ray.medium, active)},
       active);
}

/// `Scene`: SceneView or PlainScene.
template <class Model, class Scene>
inline void shade_surface_of(const Scene& scene, const ShadeSettings& settings, const Hits& hits, std::uint32_t begin,
                             std::uint32_t end, const Slots& slots, ShadowRays& shadow_rays, Rays& next_rays) {
  const Sampler sampler{scene.sampler.kind};
  const bool light_sampling = !Model::kDelta && scene.light_count > 0;
  const bool go_on = settings.next_rays && (Model::kDelta || scene.integrator.diffuse_bounces);
  for (std::uint32_t i = begin; i < end; i += kLanes) {
    const Mask active = first_lanes(end - i);
    const Hit hit = load<Hit>(scene, hits, i);
    SurfacePoint surface = make_surface_point(scene, hit, active);
    const Perturbation map = perturb_frame(scene, hit, surface, active);
    const auto bsdf = Model::load(parameter_reader(scene, hit, surface, active));
    const Vec3f wo = surface.frame.to_local(-hit.ray.direction);
    const SampleKey key = load_sample_key(slots, hit.ray.slot, active);
    if (light_sampling)
      sample_lights<Model>(scene, settings, sampler, key, hit, surface, map, bsdf, wo, shadow_rays, active);
    // The path's eta^2 is loaded where it is asked for: kept from the start, it would take a register all along.
    if (go_on)
      sample_next_ray<Model>(scene, settings, sampler, key, hit, surface, map, bsdf, wo,
                             load<Hit>(scene, hits, i).ray.eta2, next_rays, active);
  }
}

/// Hits [begin, end) of the queue; begin is a multiple of kLanes. `shadow_rays` has room for all of them.
template <class Model>
inline void shade_surface(const SceneView& scene, const ShadeSettings& settings, const Hits& hits, std::uint32_t begin,
                          std::uint32_t end, const Slots& slots, ShadowRays& shadow_rays, Rays& next_rays) {
  if (PlainScene::is_plain(scene)) {
    shade_surface_of<Model>(PlainScene(scene), settings, hits, begin, end, slots, shadow_rays, next_rays);
  } else {
    shade_surface_of<Model>(scene, settings, hits, begin, end, slots, shadow_rays, next_rays);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
