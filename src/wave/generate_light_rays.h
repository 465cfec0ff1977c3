// Stage: the wave's job -> slots and RAYS of paths that start at the lights.
#pragma once

#include "light/emit_lights.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// Apart from the numbers of the camera's paths, whose pixels and samples have the same numbers.
inline constexpr std::uint64_t kLightPathSeed = 0x5bd1e995'7feb352dull;

/// Path `path` of the `paths` that a sample of every pixel stands for. A path's Sobol' points are not those of a pixel:
/// it lands anywhere, so all paths of a replicate share one sequence, which spreads them evenly over lights and
/// directions. As many rounds of paths follow each other in a sequence as its 32-bit index holds.
NORRSKEN_INLINE SampleKey make_light_path_key(SamplerKind kind, std::uint64_t seed, UInt path, std::uint32_t paths,
                                              std::uint32_t sample) {
  seed ^= kLightPathSeed;
  if (kind == SamplerKind::independent) return make_sample_key(kind, seed, path, sample);
  const std::uint32_t round = sample / kLightReplicates, rounds = 0xffffffffu / paths;
  const UInt low(static_cast<std::uint32_t>(seed)), high(static_cast<std::uint32_t>(seed >> 32));
  const UInt key = hash(hash(hash(UInt(sample % kLightReplicates), low), high), UInt(round / rounds));
  return {key, UInt(round % rounds * paths) + path};
}

inline void generate_light_rays(const SceneView& scene, const WaveJob& job, Slots& slots, Rays& rays) {
  const Sampler sampler{scene.sampler.kind};
  const auto film_width = static_cast<std::uint32_t>(scene.film.width);
  const std::uint32_t paths = film_width * static_cast<std::uint32_t>(scene.film.height);
  const std::uint32_t pixels = job.pixel_count(), stride = job.pixel_stride();
  const Float inverse_width(1.0f / static_cast<float>(job.width));
  slots.count = job.slot_count();
  rays.count = 0;
  for (std::uint32_t s = 0; s < job.sample_count; ++s) {
    for (std::uint32_t first = 0; first < stride; first += kLanes) {
      const Mask active = first_lanes(first < pixels ? pixels - first : 0u);
      const std::uint32_t slot_base = s * stride + first;
      const UInt local = UInt(first) + lane_index();
      const UInt row = to_uint((to_float(local) + 0.5f) * inverse_width);
      const UInt path = (UInt(job.y0) + row) * UInt(film_width) + UInt(job.x0) + local - row * UInt(job.width);
      const SampleKey key =
          make_light_path_key(scene.sampler.kind, scene.sampler.seed, path, paths, job.first_sample + s);
      store_sample_key(slots, slot_base, key);

      const EmittedRay ray = emit_from_lights(scene, sampler.sample_2d(key, emission_dimension::kLight),
                                              sampler.sample_2d(key, emission_dimension::kPosition),
                                              sampler.sample_2d(key, emission_dimension::kDirection), active);
      const Mask emitted = active & ray.valid & (max_component(ray.weight) > 0.0f);
      push(scene, rays,
           Ray{.origin = ray.origin,
               .direction = ray.direction,
               .throughput = ray.weight,
               .pdf_sa = 0.0f,
               .slot = UInt(slot_base) + lane_index()},
           emitted);
    }
  }
}

}  // namespace norrsken::NORRSKEN_ISA
