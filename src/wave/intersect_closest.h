// Stage: RAYS -> LIGHT HITS, HITS by BSDF kind, and MISSES where the scene has an environment.
#pragma once

#include "camera/camera.h"
#include "wave/hits.h"
#include "wave/plain_scene.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// Those of the active lanes whose ray comes from the back of the shading normal. Not inlined: few scenes need it.
__attribute__((noinline)) inline Mask back_of_shading(const SceneView& scene, Hit hit, Mask active) {
  return active & (make_surface_point(NormalsAlone(scene), hit, active).side < 0.0f);
}

/// The lanes whose ray may come from another side of the shading normal than of the geometric one.
NORRSKEN_INLINE Mask may_be_turned(const SceneView& scene, const Hit& hit, Mask active) {
  Mask found = Mask::none();
  if (scene.first_analytic != kNone) found = active & !below(hit.primitive, scene.first_analytic);
  if (!scene.any_smooth) return found;
  const Mask triangle = active & below(hit.primitive, scene.triangle_count);
  const Float most = gather(scene.surfaces, &SurfaceRecord::turned_below, hit.primitive, triangle);
  const Vec3f normal = gather(scene.surfaces, &SurfaceRecord::geometry, hit.primitive, triangle).vector;
  Mask grazing = abs(dot(normal, hit.ray.direction)) <= most;
  // An instance's map changes angles.
  if (scene.instance_count > 0) grazing |= (hit.instance != kNone) & (most >= 0.0f);
  return found | (triangle & grazing);
}

/// The material word of the side that the geometric normal tells.
NORRSKEN_INLINE UInt material_of_side(const SceneView& scene, UInt primitive, UInt primitive_side, Mask active) {
  const UInt of_side = record_offset<SurfaceRecord>(primitive) + shift_right<31>(primitive_side);
  return gather(&scene.surfaces->material_front, of_side, active);
}

/// The material word of the side that a ray hit. Whether it emits goes by the geometric normal, as light sampling does;
/// what scatters there goes by the shading normal, as the BSDF's frame does.
NORRSKEN_INLINE UInt material_of(const SceneView& scene, const Hit& hit, UInt primitive_side, Mask active) {
  const UInt seen = material_of_side(scene, hit.primitive, primitive_side, active);
  if (!scene.any_smooth && scene.first_analytic == kNone) return seen;
  const UInt other = material_of_side(scene, hit.primitive, primitive_side ^ kBackSide, active);
  const Mask differ = active & (((seen ^ other) & ~kEmitsBit) != 0u);
  if (none(differ)) return seen;
  const Mask told = may_be_turned(scene, hit, differ);
  if (none(told)) return seen;
  const Mask back = (primitive_side & kBackSide) != 0u;
  const Mask turned = told & (back_of_shading(scene, hit, told) ^ back);
  return select(turned, (other & ~kEmitsBit) | (seen & kEmitsBit), seen);
}

/// Only hits of the BSDF kinds in the bit set `wanted_kinds` are kept. Rays from the camera end at its far plane.
inline void intersect_closest(const SceneView& scene, bool from_camera, std::uint32_t wanted_kinds, const Rays& rays,
                              Slots& slots, FoundQueues& found) {
  ClosestOfQueue hits(scene, from_camera, rays);
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    Mask active = first_lanes(rays.count - i);
    Hit hit;
    hit.ray = load<Ray>(scene, rays, i);
    active = drop_invalid(is_valid(hit.ray), hit.ray.slot, slots, active);
    const ClosestHit closest = hits.at(i, hit.ray.origin, hit.ray.direction, active);
    Mask missed = !(closest.t < kInfinity);
    if (from_camera) missed |= !(closest.t <= distance_to_far_plane(scene.camera, hit.ray.direction));
    missed &= active;
    if (scene.environment != kNone && any(missed)) push(scene, found.misses, hit.ray, missed);
    active &= !missed;
    set_end(hit, closest);
    hit.material = material_of(scene, hit, closest.primitive_side, active);

    const Mask emits = active & ((hit.material & kEmitsBit) != 0u);
    if (any(emits)) push(scene, found.light_hits, hit, emits);
    push_by_kind(scene, hit, wanted_kinds, found.hits, active);
    if (scene.any_resolved && wanted_kinds != 0) {
      const Mask unresolved = active & is_unresolved(hit.material);
      if (any(unresolved)) push(scene, found.unresolved_hits, hit, unresolved);
    }
  }
}

/// The same for a path's last ray, of which only emission counts: rays that do not point at a light are not traced.
/// They start on surfaces, so what cannot come between two points of the scene need not be looked at.
inline void intersect_emitters(const SceneView& scene, const Rays& rays, Slots& slots, FoundQueues& found) {
  ClosestOfQueue hits(scene, false, rays);
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    Mask active = first_lanes(rays.count - i);
    Hit hit;
    hit.ray = load<Ray>(scene, rays, i);
    active = drop_invalid(is_valid(hit.ray), hit.ray.slot, slots, active);
    ClosestHit closest = no_hit();
    if (scene.accel.kind == AccelKind::planes && scene.environment == kNone) {
      closest_in_planes(scene.accel, scene.accel.emitters, scene.accel.emitter_sphere_count, hit.ray.origin,
                        hit.ray.direction, closest);
      active &= closest.t < kInfinity;
      if (none(active)) continue;
      active &= !occluded_in_planes(scene.accel, hit.ray.origin, hit.ray.direction, closest.t);
    } else {
      closest = hits.at(i, hit.ray.origin, hit.ray.direction, active);
      const Mask missed = active & !(closest.t < kInfinity);
      if (scene.environment != kNone && any(missed)) push(scene, found.misses, hit.ray, missed);
      active &= !missed;
    }
    set_end(hit, closest);
    hit.material = material_of_side(scene, hit.primitive, closest.primitive_side, active);
    active &= (hit.material & kEmitsBit) != 0u;
    if (any(active)) push(scene, found.light_hits, hit, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
