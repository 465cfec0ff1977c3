// Stage: HITS of one BSDF kind, of paths from the lights -> CONNECTIONS to the camera, and the paths' next RAYS.
//
// Rays carry importance's other half: flux instead of radiance. A BSDF whose two directions change places is the same
// but for two factors, which Veach (1997, sections 5.2 and 5.3) gives:
//   eta^2, by which radiance is compressed as it is refracted and flux is not;
//   |wo.ns wi.ng| / |wo.ng wi.ns|, since cosines are taken to the shading normal ns instead of the surface's own, ng.
#pragma once

#include "camera/models.h"
#include "wave/perturbed_frame.h"
#include "wave/sample_bsdf.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// What holds for all hits of one bounce.
struct ParticleSettings {
  std::uint32_t hit_number;  ///< 1 for the hits of rays from the lights
  bool next_rays;
  bool roulette;
};

/// Veach 1997, equation 5.19: what turns f |cos wi| of radiance, seen from wo, into that of flux that comes from there.
/// `wi_local` is in the shading frame, the others are in the world.
NORRSKEN_INLINE Float flux_correction(const SurfacePoint& surface, const Vec3f& wo, const Vec3f& wo_local,
                                      const Vec3f& wi, const Vec3f& wi_local) {
  return abs((wo_local.z * dot(wi, surface.normal)) / (dot(wo, surface.normal) * wi_local.z));
}

/// eta^2 where wi is on the other side. Of the models that evaluate to anything there, those that refract tell their
/// `eta`, that of the other side over this one.
template <class Model>
NORRSKEN_INLINE Float decompression(const typename Model::Parameters& bsdf, const Vec3f& wi_local) {
  if constexpr (requires { Model::refracted_eta(bsdf); }) {
    const Float eta = Model::refracted_eta(bsdf);
    return select(wi_local.z < 0.0f, eta * eta, 1.0f);
  } else {
    return 1.0f;
  }
}

/// `film` is in pixels of the rectangle that is rendered. What lies up to a filter's reach beyond it may count.
NORRSKEN_INLINE CameraConnection connect_point(const SceneView& scene, const Vec3f& point, Vec2f lens) {
  CameraConnection c;
  switch (scene.camera.kind) {
#define NORRSKEN_CAMERA(kind, Model)               \
  case CameraKind::kind:                           \
    c = Model::connect(scene.camera, point, lens); \
    break;
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
    default:  // the host refuses sensors that nothing connects to
      c.valid = Mask::none();
      break;
  }
  const FilmSettings& film = scene.film;
  const Float reach(film.sample_border ? static_cast<float>(film.filter.edges) : 0.0f);
  c.film.x -= Float(static_cast<float>(film.crop_x)), c.film.y -= Float(static_cast<float>(film.crop_y));
  c.valid &= (c.film.x >= -reach) & (c.film.y >= -reach) & (c.film.x < Float(static_cast<float>(film.width)) + reach) &
             (c.film.y < Float(static_cast<float>(film.height)) + reach);
  return c;
}

template <class Model>
NORRSKEN_INLINE void connect_to_camera(const SceneView& scene, const Hit& hit, const SurfacePoint& surface,
                                       const typename Model::Parameters& bsdf, const Vec3f& wo_local, Vec2f lens,
                                       Connections& connections, Mask active) {
  const CameraConnection camera = connect_point(scene, surface.position, lens);
  active &= camera.valid;
  if (scene.integrator.hide_emitters && scene.any_area_light) active &= !is_emitter(scene, hit.primitive, active);
  if (none(active)) return;
  const Float side = dot(camera.target - surface.position, surface.normal);
  const Vec3f origin = spawn_origin(surface.position, surface.normal, surface.offset, side);
  const Vec3f to_camera = camera.target - origin;
  const Float distance = sqrt(dot(to_camera, to_camera));
  const Vec3f direction = to_camera * (1.0f / distance);
  const Vec3f wi = surface.frame.to_local(direction);
  const Vec3f wo_world = -hit.ray.direction;
  const Float factor =
      camera.density * decompression<Model>(bsdf, wi) * flux_correction(surface, wo_world, wo_local, direction, wi);
  const Color scattered = hit.ray.throughput * Model::evaluate(bsdf, wo_local, wi);
  // Where nothing is scattered, a cosine may be 0 and the factor infinite.
  active &= max_component(scattered) != 0.0f;
  if (none(active)) return;
  push(scene, connections,
       Connection{.ray = {.origin = origin,
                          .direction = direction,
                          .t_max = distance,
                          .contribution = scattered * factor,
                          .slot = hit.ray.slot},
                  .film = camera.film},
       active);
}

template <class Model>
NORRSKEN_INLINE void sample_next_particle(const SceneView& scene, const Sampler& sampler, const SampleKey& key,
                                          const ParticleSettings& settings, const Hit& hit, const SurfacePoint& surface,
                                          const typename Model::Parameters& bsdf, const Vec3f& wo_local,
                                          Rays& next_rays, Mask active) {
  const std::uint32_t dimension = first_dimension_of_hit(settings.hit_number);
  const BsdfSample sample = sample_bsdf<Model>(sampler, key, dimension, bsdf, wo_local);
  const Vec3f direction = surface.frame.to_world(sample.wi);
  const Float factor =
      sample.eta * sample.eta * flux_correction(surface, -hit.ray.direction, wo_local, direction, sample.wi);
  Color throughput = hit.ray.throughput * sample.weight * factor;
  active &= sample.valid & (max_component(throughput) > 0.0f);
  if (settings.roulette) {
    // By what this bounce leaves of the flux: paths differ little in how much they began with, as lights are chosen by
    // power, and its unit is the scene's.
    const Float survive = min(max_component(throughput) / max_component(hit.ray.throughput), 0.95f);
    active &= sampler.sample_1d(key, dimension + hit_dimension::kRoulette) < survive;
    throughput = throughput * (1.0f / survive);
  }
  const Vec3f origin = spawn_origin(surface.position, surface.normal, surface.offset, dot(direction, surface.normal));
  if (none(active)) return;
  push(scene, next_rays,
       Ray{.origin = origin, .direction = direction, .throughput = throughput, .pdf_sa = 0.0f, .slot = hit.ray.slot},
       active);
}

NORRSKEN_INLINE Vec2f lens_sample(const SceneView& scene, const Sampler& sampler, const SampleKey& key,
                                  const ParticleSettings& settings) {
  const CameraKind camera = scene.camera.kind;
  bool used = false;
#define NORRSKEN_CAMERA(kind, Model) used = used || (camera == CameraKind::kind && Model::kUsesLens);
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
  if (!used) return {0.5f, 0.5f};
  return sampler.sample_2d(key, first_dimension_of_hit(settings.hit_number) + hit_dimension::kLens);
}

template <class Model>
inline void shade_particles(const SceneView& scene, const ParticleSettings& settings, const Hits& hits,
                            const Slots& slots, Connections& connections, Rays& next_rays) {
  const Sampler sampler{scene.sampler.kind};
  for (std::uint32_t i = 0; i < hits.count; i += kLanes) {
    const Mask active = first_lanes(hits.count - i);
    Hit hit = load<Hit>(scene, hits, i);
    SurfacePoint surface = make_surface_point(scene, hit, active);
    const Perturbation map = perturb_frame(scene, hit, surface, active);
    const auto bsdf = Model::load(parameter_reader(scene, hit, surface, active));
    const Vec3f wo = surface.frame.to_local(-hit.ray.direction);
    // The light comes from where the ray did. (Normals are folded back by that side too, not by the viewer's.)
    if (map.count > 0) hit.ray.throughput = hit.ray.throughput * map.weight(-hit.ray.direction, wo.z);
    const SampleKey key = load_sample_key(slots, hit.ray.slot, active);
    if (!Model::kDelta) {
      const Vec2f lens = lens_sample(scene, sampler, key, settings);
      connect_to_camera<Model>(scene, hit, surface, bsdf, wo, lens, connections, active);
    }
    if (!settings.next_rays) continue;
    sample_next_particle<Model>(scene, sampler, key, settings, hit, surface, bsdf, wo, next_rays, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
