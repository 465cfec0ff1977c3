// Stage: CONNECTIONS -> SPLATS of those that reach the camera.
#pragma once

#include "accel/intersect.h"
#include "math/warp.h"
#include "wave/skip_emitters.h"

namespace norrsken::NORRSKEN_ISA {

/// A shadow ray to the camera, and where on the film it arrives.
struct Connection {
  ShadowRay ray;
  Vec2f film;
};

NORRSKEN_INLINE Connection load_connection(const Queue& q, std::uint32_t i) {
  return {load_shadow_ray(q, i), {load(q.field(kConnectionFilmX) + i), load(q.field(kConnectionFilmY) + i)}};
}
NORRSKEN_INLINE void push(Queue& q, const Connection& connection, Mask m) {
  const Compaction c = make_compaction(m);
  compress_store(q.field(kConnectionFilmX) + q.count, connection.film.x, c);
  compress_store(q.field(kConnectionFilmY) + q.count, connection.film.y, c);
  push(q, connection.ray, m);
}

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
  Mask hidden = Float(1.0f) < Float(0.0f), open = active;
  Hit hit{};
  hit.ray.origin = origin, hit.ray.direction = direction;
  Float rest = t_max;
  for (int skipped = 0; skipped < kMostSkipped && any(open); ++skipped) {
    const ClosestHit closest = intersect_closest_lanes(scene, false, hit.ray.origin, hit.ray.direction, open);
    open &= closest.t < rest;
    end_at(hit, closest);
    const Mask emitter = open & is_emitter(scene, hit.primitive, open);
    hidden |= open & !emitter;
    open = emitter;
    if (none(open)) break;
    step_behind(scene, hit, open);
    rest = select(open, rest - closest.t, rest);
  }
  return hidden;
}

inline void intersect_connections(const SceneView& scene, const Queue& connections, Queue& splats) {
  const bool look_through = scene.integrator.hide_emitters && scene.any_area_light;
  OccludedOfQueue occluded(scene, connections);
  for (std::uint32_t i = 0; i < connections.count; i += kLanes) {
    const Mask active = first_lanes(connections.count - i);
    const Connection connection = load_connection(connections, i);
    const ShadowRay& ray = connection.ray;
    const Mask hidden = look_through ? hidden_by_others_than_emitters(scene, copied(ray.origin), copied(ray.direction),
                                                                      ray.t_max, active)
                                     : hidden_from_camera(scene, occluded, i, ray, active);
    const Mask visible = active & !hidden;
    if (none(visible)) continue;
    const Compaction c = make_compaction(visible);
    compress_store(splats.field(kSplatFilmX) + splats.count, connection.film.x, c);
    compress_store(splats.field(kSplatFilmY) + splats.count, connection.film.y, c);
    compress_store3(splats, kSplatRed, splats.count, ray.contribution, c);
    compress_store(splats.field(kSplatSlot) + splats.count, ray.slot, c);
    splats.count += c.count;
  }
}

}  // namespace norrsken::NORRSKEN_ISA
