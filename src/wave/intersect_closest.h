// Stage: RAYS -> LIGHT HITS, HITS by BSDF kind, and MISSES where the scene has an environment.
#pragma once

#include "camera/camera.h"
#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

/// Those of the active lanes whose ray comes from the back of the shading normal. Not inlined: few scenes need it.
__attribute__((noinline)) inline Mask back_of_shading(const SceneView& scene, Hit hit, Mask active) {
  return active & (make_surface_point(scene, hit, active).side < Float(0.0f));
}

/// The lanes whose ray may come from another side of the shading normal than of the geometric one.
NORRSKEN_INLINE Mask may_be_turned(const SceneView& scene, const Hit& hit, Mask active) {
  Mask found = Float(1.0f) < Float(0.0f);
  if (scene.first_analytic != kNone) found = active & !below(hit.primitive, scene.first_analytic);
  if (!scene.any_smooth) return found;
  const Mask triangle = active & below(hit.primitive, scene.triangle_count);
  const UInt shape = shape_index(shape_of(scene, hit.primitive, triangle));
  const Float most = gather(reinterpret_cast<const float*>(scene.shapes) + kTurnedBelow, shape, triangle);
  const Vec3f normal = gather3(surface_floats(scene), record_index(hit.primitive), triangle);
  Mask grazing = abs(dot(normal, hit.ray.direction)) <= most;
  // An instance's map changes angles.
  if (scene.instance_count > 0) grazing |= (hit.instance != UInt(kNone)) & (most >= Float(0.0f));
  return found | (triangle & grazing);
}

/// The material word of the side that the geometric normal tells.
NORRSKEN_INLINE UInt material_of_side(const SceneView& scene, UInt primitive, UInt primitive_side, Mask active) {
  return gather_uint(surface_floats(scene) + 4, record_index(primitive) + shift_right<31>(primitive_side), active);
}

/// The material word of the side that a ray hit. Whether it emits goes by the geometric normal, as light sampling does;
/// what scatters there goes by the shading normal, as the BSDF's frame does.
NORRSKEN_INLINE UInt material_of(const SceneView& scene, const Hit& hit, UInt primitive_side, Mask active) {
  const UInt seen = material_of_side(scene, hit.primitive, primitive_side, active);
  if (!scene.any_smooth && scene.first_analytic == kNone) return seen;
  const UInt other = material_of_side(scene, hit.primitive, primitive_side ^ UInt(kBackSide), active);
  const Mask differ = active & (((seen ^ other) & UInt(~kEmitsBit)) != UInt(0u));
  if (none(differ)) return seen;
  const Mask told = may_be_turned(scene, hit, differ);
  if (none(told)) return seen;
  const Mask back = (primitive_side & UInt(kBackSide)) != UInt(0u);
  const Mask turned = told & (back_of_shading(scene, hit, told) ^ back);
  return select(turned, (other & UInt(~kEmitsBit)) | (seen & UInt(kEmitsBit)), seen);
}

inline constexpr std::uint32_t kModelKinds = (1u << kModelCount) - 1u;

/// To the queue of the model that the hit's material names, if it is in the bit set `wanted_kinds`.
NORRSKEN_INLINE void push_by_kind(const SceneView& scene, const Hit& hit, std::uint32_t wanted_kinds,
                                  WaveMemory& memory, Mask active) {
  const UInt kind_bits = hit.material & UInt(kMaterialKindMask);
  for (std::uint32_t kinds = scene.bsdf_kinds & wanted_kinds & kModelKinds; kinds != 0; kinds &= kinds - 1) {
    const auto kind = static_cast<std::uint32_t>(__builtin_ctz(kinds));
    const Mask of_kind = active & (kind_bits == UInt(kind << 24));
    if (any(of_kind)) push(scene, memory.hits[kind], hit, of_kind);
  }
}

/// `hit_number` 1: the rays come from the camera. Only hits of the BSDF kinds in the bit set `wanted_kinds` are kept.
inline void intersect_closest(const SceneView& scene, std::uint32_t hit_number, std::uint32_t wanted_kinds,
                              const Queue& rays, WaveMemory& memory) {
  const bool from_camera = hit_number == 1;
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    Mask active = first_lanes(rays.count - i);
    Hit hit;
    hit.ray = load_ray(scene, rays, i);
    active = keep_sound(is_sound(hit.ray), hit.ray.slot, memory.slots, active);
    const ClosestHit closest = intersect_closest_lanes(scene, from_camera, hit.ray.origin, hit.ray.direction, active);
    Mask missed = !(closest.t < Float(kInfinity));
    if (from_camera) missed |= !(closest.t <= distance_to_far_plane(scene.camera, hit.ray.direction));
    missed &= active;
    if (scene.environment != kNone && any(missed)) push(scene, memory.misses, hit.ray, missed);
    active &= !missed;
    end_at(hit, closest);
    hit.material = material_of(scene, hit, closest.primitive_side, active);

    const Mask emits = active & ((hit.material & UInt(kEmitsBit)) != UInt(0u));
    if (any(emits)) push(scene, memory.light_hits, hit, emits);
    push_by_kind(scene, hit, wanted_kinds, memory, active);
    if (scene.any_resolved && wanted_kinds != 0) {
      const UInt kind_bits = hit.material & UInt(kMaterialKindMask);
      const Mask stands_before = active & !(to_float(kind_bits) < Float(static_cast<float>(kModelCount << 24)));
      if (any(stands_before)) push(scene, memory.unresolved_hits, hit, stands_before);
    }
  }
}

/// The same for a path's last ray, of which only emission counts: rays that do not point at a light are not traced.
/// They start on surfaces, so what cannot come between two points of the scene need not be looked at.
inline void intersect_emitters(const SceneView& scene, const Queue& rays, WaveMemory& memory) {
  for (std::uint32_t i = 0; i < rays.count; i += kLanes) {
    Mask active = first_lanes(rays.count - i);
    Hit hit;
    hit.ray = load_ray(scene, rays, i);
    active = keep_sound(is_sound(hit.ray), hit.ray.slot, memory.slots, active);
    ClosestHit closest = no_hit();
    if (scene.accel.kind == AccelKind::planes && scene.environment == kNone) {
      closest_in_planes(scene.accel, scene.accel.emitters, scene.accel.emitter_sphere_count, hit.ray.origin,
                        hit.ray.direction, closest);
      active &= closest.t < Float(kInfinity);
      if (none(active)) continue;
      active &= !occluded_in_planes(scene.accel, hit.ray.origin, hit.ray.direction, closest.t);
    } else {
      closest = intersect_closest_lanes(scene, false, hit.ray.origin, hit.ray.direction, active);
      const Mask missed = active & !(closest.t < Float(kInfinity));
      if (scene.environment != kNone && any(missed)) push(scene, memory.misses, hit.ray, missed);
      active &= !missed;
    }
    end_at(hit, closest);
    hit.material = material_of_side(scene, hit.primitive, closest.primitive_side, active);
    active &= (hit.material & UInt(kEmitsBit)) != UInt(0u);
    if (any(active)) push(scene, memory.light_hits, hit, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
