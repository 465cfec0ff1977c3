// Rays through Embree, for meshes: packets where rays are coherent (from the camera), one by one where they are not,
// which Embree serves as fast as packets. Spheres are user geometry answered by src/accel/embree_build.cpp.
#pragma once

#include <embree3/rtcore.h>

#include "accel/hit.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// The bits that tell how a hit in Embree's terms is numbered here: geometry 0 holds all triangles, 1 all spheres.
NORRSKEN_INLINE std::uint32_t primitive_of(const SceneView& scene, std::uint32_t geometry, std::uint32_t primitive) {
  return geometry == 0 ? primitive : scene.accel.spheres[primitive].primitive;
}

/// Fills `hit` for the active lanes with the closest hit nearer than `hit.t`.
inline void closest_in_embree(const SceneView& scene, bool coherent, const Vec3f& o, const Vec3f& d, ClosestHit& hit,
                              Mask active) {
  auto* embree = static_cast<RTCScene>(scene.accel.embree_scene);
  alignas(64) float ox[kMaxLanes], oy[kMaxLanes], oz[kMaxLanes], dx[kMaxLanes], dy[kMaxLanes], dz[kMaxLanes];
  alignas(64) float t[kMaxLanes], side[kMaxLanes];
  store(ox, o.x), store(oy, o.y), store(oz, o.z);
  store(dx, d.x), store(dy, d.y), store(dz, d.z);
  store(t, hit.t), store(side, hit.primitive_side);
  const std::uint32_t lanes = to_bits(active);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);

  const auto answer = [&](int i, float tfar, std::uint32_t geometry, std::uint32_t primitive, const float& ng_x,
                          const float& ng_y, const float& ng_z) {
    if (geometry == RTC_INVALID_GEOMETRY_ID) return;
    const float n_dot_d = ng_x * dx[i] + ng_y * dy[i] + ng_z * dz[i];
    const std::uint32_t word = primitive_of(scene, geometry, primitive) | (n_dot_d > 0.0f ? kBackSide : 0u);
    t[i] = tfar;
    __builtin_memcpy(&side[i], &word, sizeof word);
  };

  if (coherent && kLanes > 1) {
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) int valid[16];
    alignas(64) RTCRayHit16 packet;
    for (int i = 0; i < 16; ++i) {
      const bool on = i < kLanes && ((lanes >> i) & 1u) != 0;
      valid[i] = on ? -1 : 0;
      if (!on) continue;
      packet.ray.org_x[i] = ox[i], packet.ray.org_y[i] = oy[i], packet.ray.org_z[i] = oz[i];
      packet.ray.dir_x[i] = dx[i], packet.ray.dir_y[i] = dy[i], packet.ray.dir_z[i] = dz[i];
      packet.ray.tnear[i] = 0.0f, packet.ray.tfar[i] = t[i];
      packet.ray.time[i] = 0.0f, packet.ray.mask[i] = ~0u, packet.ray.id[i] = 0u, packet.ray.flags[i] = 0u;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, embree, &context, &packet);
    for (int i = 0; i < kLanes; ++i) {
      if (valid[i] == 0) continue;
      answer(i, packet.ray.tfar[i], packet.hit.geomID[i], packet.hit.primID[i], packet.hit.Ng_x[i], packet.hit.Ng_y[i],
             packet.hit.Ng_z[i]);
    }
  } else {
    for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
      const int i = __builtin_ctz(rest);
      RTCRayHit one;
      one.ray.org_x = ox[i], one.ray.org_y = oy[i], one.ray.org_z = oz[i];
      one.ray.dir_x = dx[i], one.ray.dir_y = dy[i], one.ray.dir_z = dz[i];
      one.ray.tnear = 0.0f, one.ray.tfar = t[i], one.ray.time = 0.0f;
      one.ray.mask = ~0u, one.ray.id = 0u, one.ray.flags = 0u;
      one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(embree, &context, &one);
      answer(i, one.ray.tfar, one.hit.geomID, one.hit.primID, one.hit.Ng_x, one.hit.Ng_y, one.hit.Ng_z);
    }
  }
  hit.t = load(t);
  hit.primitive_side = load_uint(side);
}

inline Mask occluded_in_embree(const SceneView& scene, const Vec3f& o, const Vec3f& d, Float t_max, Mask active) {
  auto* embree = static_cast<RTCScene>(scene.accel.embree_scene);
  alignas(64) float ox[kMaxLanes], oy[kMaxLanes], oz[kMaxLanes], dx[kMaxLanes], dy[kMaxLanes], dz[kMaxLanes];
  alignas(64) float t[kMaxLanes];
  store(ox, o.x), store(oy, o.y), store(oz, o.z);
  store(dx, d.x), store(dy, d.y), store(dz, d.z);
  store(t, t_max);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::uint32_t rest = to_bits(active); rest != 0; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    RTCRay ray;
    ray.org_x = ox[i], ray.org_y = oy[i], ray.org_z = oz[i];
    ray.dir_x = dx[i], ray.dir_y = dy[i], ray.dir_z = dz[i];
    ray.tnear = 0.0f, ray.tfar = t[i], ray.time = 0.0f;
    ray.mask = ~0u, ray.id = 0u, ray.flags = 0u;
    rtcOccluded1(embree, &context, &ray);
    t[i] = ray.tfar;  // minus infinity says occluded
  }
  return active & (load(t) < Float(0.0f));
}

}  // namespace norrsken::NORRSKEN_ISA
