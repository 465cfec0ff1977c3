// All kernels, compiled once per instruction set: the build sets NORRSKEN_ISA, NORRSKEN_LANES and the compiler's flags.
#include "isa/entry.h"
#include "wave/schedule.h"
#include "wave/trace_particles.h"

namespace norrsken::NORRSKEN_ISA {
namespace {

void run_shade_surface(const SceneView& scene, BsdfKind kind, std::uint32_t hit_number, bool roulette,
                       const Queue& hits, const Queue& slots, Queue& shadow_rays, Queue& next_rays) {
  const ShadeSettings settings{hit_number, 0, static_cast<std::uint32_t>(scene.integrator.emitter_samples), true,
                               roulette};
  switch (kind) {
#define NORRSKEN_BSDF(kind, Model)                                                             \
  case BsdfKind::kind:                                                                         \
    shade_surface<Model>(scene, settings, hits, 0, hits.count, slots, shadow_rays, next_rays); \
    break;
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
    default:  // nothing is shaded with those
      break;
  }
}

NORRSKEN_INLINE Vec3f load_rays(const float* x, const float* y, const float* z, std::uint32_t i) {
  return {load(x + i), load(y + i), load(z + i)};
}

RayFields fields_of(const RayArrays& rays) {
  const float* const o[3] = {rays.ox, rays.oy, rays.oz};
  const float* const d[3] = {rays.dx, rays.dy, rays.dz};
  return {o, d};
}

void run_closest_rays(const SceneView& scene, bool coherent, const RayArrays& rays, float* t,
                      std::uint32_t* primitive_side) {
  ClosestOfQueue hits(scene, coherent, fields_of(rays), rays.count);
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    const Mask active = first_lanes(rays.count - i);
    const ClosestHit hit =
        hits.at(i, load_rays(rays.ox, rays.oy, rays.oz, i), load_rays(rays.dx, rays.dy, rays.dz, i), active);
    store(t + i, hit.t);
    store(reinterpret_cast<float*>(primitive_side) + i,
          select(hit.t < Float(kInfinity), hit.primitive_side, UInt(kNone)));
  }
}

void run_occluded_rays(const SceneView& scene, const RayArrays& rays, const float* t_max, std::uint8_t* occluded) {
  OccludedOfQueue hidden(scene, fields_of(rays), t_max, rays.count);
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    const Mask active = first_lanes(rays.count - i);
    const std::uint32_t lanes = to_bits(hidden.at(i, load_rays(rays.ox, rays.oy, rays.oz, i),
                                                  load_rays(rays.dx, rays.dy, rays.dz, i), load(t_max + i), active));
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(kLanes) && i + k < rays.count; ++k) {
      occluded[i + k] = static_cast<std::uint8_t>((lanes >> k) & 1u);
    }
  }
}

void run_sample_2d(SamplerKind kind, std::uint64_t seed, std::uint32_t sample, std::uint32_t dimension,
                   std::uint32_t count, float* x, float* y) {
  const Sampler sampler{kind};
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    const SampleKey key = make_sample_key(kind, seed, UInt(i) + lane_index(), sample);
    const Vec2f u = sampler.sample_2d(key, dimension);
    store(x + i, u.x);
    store(y + i, u.y);
  }
}

}  // namespace

extern const KernelEntry kEntry;
const KernelEntry kEntry = {
    NORRSKEN_ISA_NAME,   kLanes,
    trace_wave,          trace_features,
    trace_particles,     accumulate_film,
    accumulate_features, generate_camera_rays,
    intersect_closest,   intersect_emitters,
    intersect_shadow,    shade_emission,
    shade_miss,          run_shade_surface,
    run_closest_rays,    run_occluded_rays,
    run_sample_2d,
};

}  // namespace norrsken::NORRSKEN_ISA
