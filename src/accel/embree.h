// Rays through Embree, for meshes: packets where rays are coherent (from the camera), one by one where they are not,
// which Embree serves as fast as packets. What Embree does not know by itself (spheres, shapes with a formula) is user
// geometry answered by src/accel/embree_user.cpp.
#pragma once

#include <embree3/rtcore.h>

#include "accel/hit.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// As many rays as a register has lanes, in Embree's order of fields.
using RayPacket = RTCRayNt<kLanes>;
using HitPacket = RTCHitNt<kLanes>;

NORRSKEN_INLINE void store_rays(RayPacket& rays, const Vec3f& o, const Vec3f& d, Float t_max) {
  store(rays.org_x, o.x), store(rays.org_y, o.y), store(rays.org_z, o.z);
  store(rays.dir_x, d.x), store(rays.dir_y, d.y), store(rays.dir_z, d.z);
  store(rays.tnear, Float(0.0f)), store(rays.tfar, t_max), store(rays.time, Float(0.0f));
}

NORRSKEN_INLINE RTCRay ray_of_lane(const RayPacket& rays, int i) {
  RTCRay ray;
  ray.org_x = rays.org_x[i], ray.org_y = rays.org_y[i], ray.org_z = rays.org_z[i];
  ray.dir_x = rays.dir_x[i], ray.dir_y = rays.dir_y[i], ray.dir_z = rays.dir_z[i];
  ray.tnear = 0.0f, ray.tfar = rays.tfar[i], ray.time = 0.0f;
  ray.mask = ~0u, ray.id = 0u, ray.flags = 0u;
  return ray;
}

/// All rays at once.
inline void intersect_packet(RTCScene embree, RTCRayHitNt<kLanes>& packet, Mask active) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) int valid[kLanes];
  const std::uint32_t lanes = to_bits(active);
  for (int i = 0; i < kLanes; ++i) {
    valid[i] = ((lanes >> i) & 1u) != 0 ? -1 : 0;
    packet.ray.mask[i] = ~0u, packet.ray.id[i] = 0u, packet.ray.flags[i] = 0u;
  }
  if constexpr (kLanes == 4) rtcIntersect4(valid, embree, &context, reinterpret_cast<RTCRayHit4*>(&packet));
  if constexpr (kLanes == 8) rtcIntersect8(valid, embree, &context, reinterpret_cast<RTCRayHit8*>(&packet));
  if constexpr (kLanes == 16) rtcIntersect16(valid, embree, &context, reinterpret_cast<RTCRayHit16*>(&packet));
}

/// One ray after the other.
inline void intersect_singly(RTCScene embree, RTCRayHitNt<kLanes>& packet, Mask active) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::uint32_t rest = to_bits(active); rest != 0; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    RTCRayHit one;
    one.ray = ray_of_lane(packet.ray, i);
    one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree, &context, &one);
    if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    packet.ray.tfar[i] = one.ray.tfar;
    packet.hit.Ng_x[i] = one.hit.Ng_x, packet.hit.Ng_y[i] = one.hit.Ng_y, packet.hit.Ng_z[i] = one.hit.Ng_z;
    packet.hit.geomID[i] = one.hit.geomID, packet.hit.primID[i] = one.hit.primID;
    packet.hit.instID[0][i] = one.hit.instID[0];
  }
}

NORRSKEN_INLINE UInt load_words(const unsigned* words) {
  alignas(64) float values[kLanes];
  __builtin_memcpy(values, words, sizeof values);
  return load_uint(values);
}

/// Embree's numbers of what was hit become the scene's, in place: primID a primitive, instID an instance or kNone.
NORRSKEN_INLINE void number_hits(const AccelView& accel, HitPacket& hits, Mask hit) {
  for (std::uint32_t rest = to_bits(hit); rest != 0; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    const EmbreeGeometry* geometries = accel.embree_geometries;
    if (hits.instID[0][i] != RTC_INVALID_GEOMETRY_ID) {
      hits.instID[0][i] -= accel.first_instance;
      geometries += accel.instance_geometries[hits.instID[0][i]];
    }
    const EmbreeGeometry& geometry = geometries[hits.geomID[i]];
    hits.primID[i] = geometry.first_primitive + geometry.step * hits.primID[i];
  }
}

/// The closest hit; nearer than infinity for active lanes alone.
inline ClosestHit closest_in_embree(const SceneView& scene, bool coherent, Vec3f o, Vec3f d, Mask active) {
  ClosestHit hit = no_hit();
  active &= is_ray(o, d);
  auto* embree = static_cast<RTCScene>(scene.accel.embree_scene);
  alignas(64) RTCRayHitNt<kLanes> packet;
  store_rays(packet.ray, o, d, hit.t);
  __builtin_memset(&packet.hit, 0xff, sizeof packet.hit);
  static_assert(RTC_INVALID_GEOMETRY_ID == 0xffffffffu && kNone == RTC_INVALID_GEOMETRY_ID);
  if (coherent && kLanes > 1) {
    intersect_packet(embree, packet, active);
  } else {
    intersect_singly(embree, packet, active);
  }

  const Mask found = active & (load_words(packet.hit.geomID) != UInt(RTC_INVALID_GEOMETRY_ID));
  if (none(found)) return hit;
  number_hits(scene.accel, packet.hit, found);
  // Embree's normals are those of the instance's space.
  Vec3f object_d = d;
  if (scene.instance_count > 0) {
    const UInt instance = load_words(packet.hit.instID[0]);
    const Mask instanced = found & (instance != UInt(kNone));
    if (any(instanced)) {
      object_d = select(instanced, object_from_world(scene.instances, instance, instanced).vector(d), d);
    }
    hit.instance = select(found, instance, hit.instance);
  }
  const Vec3f n{load(packet.hit.Ng_x), load(packet.hit.Ng_y), load(packet.hit.Ng_z)};
  const UInt side = select(dot(n, object_d) > Float(0.0f), UInt(kBackSide), UInt(0u));
  hit.t = select(found, load(packet.ray.tfar), hit.t);
  hit.primitive_side = select(found, side | load_words(packet.hit.primID), hit.primitive_side);
  return hit;
}

inline Mask occluded_in_embree(const SceneView& scene, Vec3f o, Vec3f d, Float t_max, Mask active) {
  active &= is_ray(o, d) & (t_max > Float(0.0f));
  auto* embree = static_cast<RTCScene>(scene.accel.embree_scene);
  alignas(64) RayPacket rays;
  store_rays(rays, o, d, t_max);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::uint32_t rest = to_bits(active); rest != 0; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    RTCRay ray = ray_of_lane(rays, i);
    rtcOccluded1(embree, &context, &ray);
    rays.tfar[i] = ray.tfar;  // minus infinity says occluded
  }
  return active & (load(rays.tfar) < Float(0.0f));
}

}  // namespace norrsken::NORRSKEN_ISA
