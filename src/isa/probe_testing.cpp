// The probes' functions, compiled once per instruction set.
#include "isa/probe_testing.h"

#include "bsdf/models.h"
#include "isa/ray_arrays.h"
#include "sampler/sampler.h"
#include "wave/generate_camera_rays.h"
#include "wave/intersect_closest.h"
#include "wave/intersect_shadow.h"
#include "wave/shade_emission.h"
#include "wave/shade_miss.h"
#include "wave/shade_surface.h"
#include "wave/skip_emitters.h"

namespace norrsken::NORRSKEN_ISA {
namespace {

void shade_surface_of_kind(const SceneView& scene, BsdfKind kind, std::uint32_t hit_number, bool roulette,
                           const Hits& hits, const Slots& slots, ShadowRays& shadow_rays, Rays& next_rays) {
  const ShadeSettings settings{.hit_number = hit_number,
                               .end_light_sample = static_cast<std::uint32_t>(scene.integrator.emitter_samples),
                               .next_rays = true,
                               .roulette = roulette};
  if (kind == BsdfKind::diffuse) {
    shade_surface<Diffuse>(scene, settings, hits, 0, hits.count, slots, shadow_rays, next_rays);
  } else if (kind == BsdfKind::conductor) {
    shade_surface<Conductor>(scene, settings, hits, 0, hits.count, slots, shadow_rays, next_rays);
  }
}

void closest_rays(const SceneView& scene, bool coherent, const RayArrays& arrays, float* t,
                  std::uint32_t* primitive_side) {
  const RayFields rays = fields_of(arrays);
  ClosestOfQueue hits(scene, coherent, rays, arrays.count);
  for (std::uint32_t i = 0; i < arrays.count; i += kLanes) {
    const Mask active = first_lanes(arrays.count - i);
    const ClosestHit hit = hits.at(i, rays.load_origin(i), rays.load_direction(i), active);
    store(t + i, hit.t);
    store(reinterpret_cast<float*>(primitive_side) + i,
          select(hit.t < Float(kInfinity), hit.primitive_side, UInt(kNone)));
  }
}

void sample_2d(SamplerKind kind, std::uint64_t seed, std::uint32_t sample, std::uint32_t dimension, std::uint32_t count,
               float* x, float* y) {
  const Sampler sampler{kind};
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    const SampleKey key = make_sample_key(kind, seed, UInt(i) + lane_index(), sample);
    const Vec2f u = sampler.sample_2d(key, dimension);
    store(x + i, u.x);
    store(y + i, u.y);
  }
}

}  // namespace

extern const KernelProbe kProbe;
const KernelProbe kProbe = {
    .name = NORRSKEN_ISA_NAME,
    .generate_camera_rays = generate_camera_rays,
    .skip_emitters = skip_emitters,
    .intersect_closest = intersect_closest,
    .intersect_emitters = intersect_emitters,
    .intersect_shadow = intersect_shadow,
    .shade_emission = shade_emission,
    .shade_miss = shade_miss,
    .shade_surface = shade_surface_of_kind,
    .closest_rays = closest_rays,
    .sample_2d = sample_2d,
};

}  // namespace norrsken::NORRSKEN_ISA
