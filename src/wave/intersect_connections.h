// Stage: CONNECTIONS -> SPLATS of those that reach the camera.
#pragma once

#include "accel/intersect.h"

namespace norrsken::NORRSKEN_ISA {

/// Unlike a light, the camera need not be where the scene is: walls that cannot come between two points of the scene
/// (docs/pipeline.md) can hide it from the camera.
NORRSKEN_INLINE Mask hidden_from_camera(const SceneView& scene, OccludedOfQueue& occluded, std::uint32_t i,
                                        const ShadowRay& ray, Mask active) {
  if (scene.accel.kind != AccelKind::planes) return occluded.at(i, ray.origin, ray.direction, ray.t_max, active);
  return active & (intersect_closest_lanes(scene, false, ray.origin, ray.direction, active).t < ray.t_max);
}

/// The same for a camera that looks through the surfaces of emitters.
inline Mask hidden_by_others_than_emitters(const SceneView& scene, Vec3f origin, Vec3f direction, Float t_max,
                                           Mask active) {
  Mask hidden = Mask::none(), open = active;
  Hit hit{};
  hit.ray.origin = origin, hit.ray.direction = direction;
  Float rest = t_max;
  for (int skipped = 0; skipped < kMostSkipped && any(open); ++skipped) {
    const ClosestHit closest = intersect_closest_lanes(scene, false, hit.ray.origin, hit.ray.direction, open);
    open &= closest.t < rest;
    set_end(hit, closest);
    const Mask emitter = open & is_emitter(scene, hit.primitive, open);
    hidden |= open & !emitter;
    open = emitter;
    if (none(open)) break;
    step_behind(scene, hit, open);
    rest = select(open, rest - closest.t, rest);
  }
  return hidden;
}

inline void intersect_connections(const SceneView& scene, const Connections& connections, Splats& splats) {
  const bool look_through = scene.integrator.hide_emitters && scene.any_area_light;
  OccludedOfQueue occluded(scene, connections);
  for (std::uint32_t i = 0; i < connections.count; i += kLanes) {
    const Mask active = first_lanes(connections.count - i);
    const Connection connection = load<Connection>(scene, connections, i);
    const ShadowRay& ray = connection.ray;
    const Mask hidden = look_through ? hidden_by_others_than_emitters(scene, copied(ray.origin), copied(ray.direction),
                                                                      ray.t_max, active)
                                     : hidden_from_camera(scene, occluded, i, ray, active);
    const Mask visible = active & !hidden;
    if (none(visible)) continue;
    push(scene, splats, Splat{.film = connection.film, .radiance = ray.contribution, .slot = ray.slot}, visible);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
