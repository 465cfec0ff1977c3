// Stage: SCATTERS of one phase function -> SHADOW RAYS to the lights, and the paths' next RAYS.
#pragma once

#include "wave/scatter.h"
#include "wave/shade_surface.h"

namespace norrsken::NORRSKEN_ISA {

template <class Phase>
inline void shade_scatters(const SceneView& scene, const ShadeSettings& settings, const Scatters& scatters,
                           std::uint32_t begin, std::uint32_t end, const Slots& slots, ShadowRays& shadow_rays,
                           Rays& next_rays) {
  const Sampler sampler{scene.sampler.kind};
  const std::uint32_t dimension = first_dimension_of_hit(settings.hit_number);
  const auto n = static_cast<std::uint32_t>(scene.integrator.emitter_samples);
  const Float light_samples(static_cast<float>(n));
  const bool samples_lights = scene.light_count > 0 && n > 0;
  for (std::uint32_t i = begin; i < end; i += kLanes) {
    Mask active = first_lanes(end - i);
    const Scatter scatter = load<Scatter>(scene, scatters, i);
    const Ray& ray = scatter.ray;
    const auto phase = Phase::load(PhaseReader{scene, scatter.phase & kPhaseOffsetMask, ray.origin, active});
    const Vec3f wo = -ray.direction;
    const SampleKey key = load_sample_key(slots, ray.slot, active);
    Mask lit = Mask::none();
    if (samples_lights) lit = active & (gather_medium(scene, &MediumRecord::sample_emitters, ray.medium, active) != 0u);

    for (std::uint32_t s = settings.first_light_sample; s < settings.end_light_sample && any(lit); ++s) {
      const SampleKey k = sampler.repetition(key, s, n);
      Vec2f pick{0.0f, 0.0f};
      if (scene.light_count > 1) pick = sampler.sample_2d(k, dimension + hit_dimension::kLight);
      const Vec2f u = sampler.sample_2d(k, dimension + hit_dimension::kLightPosition);
      const LightChoice light = sample_one_light(scene, ray.origin, any_receiver(), pick, u, lit);
      const Vec3f to_light = light.sample.point - ray.origin;
      const Float distance = sqrt(dot(to_light, to_light));
      const Vec3f direction = to_light * (1.0f / distance);
      const Float scatters_there = Phase::pdf_sa(phase, wo, direction);
      const Float light_pdf = light.prob * light.sample.pdf_sa;
      const Float competing =
          select(light.delta, 1.0f,
                 power_heuristic(light_samples, light.weight_prob * light.sample.pdf_sa, 1.0f, scatters_there));
      const Float weight = scatters_there * competing / (light_pdf * light_samples);
      const Color contribution = ray.throughput * light.sample.radiance * weight;
      const Mask sees = lit & light.sample.valid & (max_component(contribution) != 0.0f);
      if (none(sees)) continue;
      push(scene, shadow_rays,
           ShadowRay{.origin = ray.origin,
                     .direction = direction,
                     .t_max = distance,
                     .contribution = contribution,
                     .slot = ray.slot,
                     .medium = ray.medium},
           sees);
    }
    if (!settings.next_rays) continue;
    const PhaseSample sample =
        Phase::sample(phase, wo, sampler.sample_2d(key, dimension + hit_dimension::kBsdfDirection));
    Color throughput = ray.throughput;
    if (settings.roulette) {
      const Float survive = survival_probability(throughput, ray.eta2);
      active &= sampler.sample_1d(key, dimension + hit_dimension::kRoulette) < survive;
      throughput = throughput * (1.0f / survive);
    }
    if (none(active)) continue;
    push(scene, next_rays,
         Ray{.origin = ray.origin,
             .direction = sample.wi,
             .throughput = throughput,
             .pdf_sa = select(lit, sample.pdf_sa, 0.0f),
             .slot = ray.slot,
             .eta2 = ray.eta2,
             .medium = ray.medium},
         active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
