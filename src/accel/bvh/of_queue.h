// Rays against a hierarchy of triangles and what stands beside it, by the queue: some hundred are asked for at a time,
// and answered register by register.
#pragma once

#include "accel/bvh/beside.h"
#include "accel/bvh/traverse.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// Rays that are asked for at a time: a wave's.
inline constexpr std::uint32_t kRaysAtATime = 1024;

/// Directions and origins of a queue's records, from the record `first` on.
struct RayFields {
  const float* origin[3];
  const float* direction[3];

  RayFields(const float* const o[3], const float* const d[3], std::uint32_t first = 0)
      : origin{o[0] + first, o[1] + first, o[2] + first}, direction{d[0] + first, d[1] + first, d[2] + first} {}
  /// Components `stride` apart.
  RayFields(const float* o, const float* d, std::size_t stride)
      : origin{o, o + stride, o + 2 * stride}, direction{d, d + stride, d + 2 * stride} {}
  template <class Record>
  explicit RayFields(const Queue<Record>& q)
      : RayFields(q.field(&Record::origin), q.field(&Record::direction), q.stride()) {}
  explicit RayFields(const Queue<stored::Connection>& q)
      : RayFields(q.field(&stored::Connection::ray, &stored::ShadowRay::origin),
                  q.field(&stored::Connection::ray, &stored::ShadowRay::direction), q.stride()) {}
  RayFields from(std::uint32_t first) const { return {origin, direction, first}; }

  NORRSKEN_INLINE Vec3f load_origin(std::uint32_t i) const {
    return {load(origin[0] + i), load(origin[1] + i), load(origin[2] + i)};
  }
  NORRSKEN_INLINE Vec3f load_direction(std::uint32_t i) const {
    return {load(direction[0] + i), load(direction[1] + i), load(direction[2] + i)};
  }
};

/// Answers to `count` rays, in whole registers: what lies behind the last is of no meaning.
inline void closest_in_bvh(const AccelView& accel, const RayFields& rays, std::uint32_t count, float* t,
                           std::uint32_t* primitive_side) {
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    ClosestHit hit = no_hit();
    closest_beside(accel, rays.load_origin(i), rays.load_direction(i), hit);
    store(t + i, hit.t);
    store(reinterpret_cast<float*>(primitive_side) + i, hit.primitive_side);
  }
  traverse<Query::closest>(accel.bvh, {{rays.origin[0], rays.origin[1], rays.origin[2]},
                                       {rays.direction[0], rays.direction[1], rays.direction[2]},
                                       t,
                                       primitive_side,
                                       count});
}

/// `t` becomes negative where anything is nearer.
inline void occluded_in_bvh(const AccelView& accel, const RayFields& rays, std::uint32_t count, float* t) {
  if (accel.sphere_count + accel.analytic_count > 0) {
    for (std::uint32_t i = 0; i < count; i += kLanes) {
      const Float t_max = load(t + i);
      const Mask occluded = occluded_beside(accel, rays.load_origin(i), rays.load_direction(i), t_max);
      store(t + i, select(occluded, Float(-kInfinity), t_max));
    }
  }
  traverse<Query::occlusion>(accel.bvh, {{rays.origin[0], rays.origin[1], rays.origin[2]},
                                         {rays.direction[0], rays.direction[1], rays.direction[2]},
                                         t,
                                         nullptr,
                                         count});
}

/// One register of rays, as arrays: those that are not active become no rays.
struct LaneRays {
  alignas(64) float values[6][kLanes];

  NORRSKEN_INLINE LaneRays(const Vec3f& o, const Vec3f& d, Mask active) {
    const Float none = from_bits(UInt(0x7fc00000u));  // not a number
    store(values[0], select(active, o.x, none)), store(values[1], o.y), store(values[2], o.z);
    store(values[3], d.x), store(values[4], d.y), store(values[5], d.z);
  }
  NORRSKEN_INLINE RayFields fields() const {
    const float* const o[3] = {values[0], values[1], values[2]};
    const float* const d[3] = {values[3], values[4], values[5]};
    return {o, d};
  }
};

/// One register of rays: for what asks for few.
inline ClosestHit closest_in_bvh(const AccelView& accel, Vec3f o, Vec3f d, Mask active) {
  const LaneRays rays(o, d, active);
  alignas(64) float t[kLanes];
  alignas(64) std::uint32_t primitive_side[kLanes];
  closest_in_bvh(accel, rays.fields(), kLanes, t, primitive_side);
  return {load(t), load_uint(reinterpret_cast<const float*>(primitive_side))};
}

inline Mask occluded_in_bvh(const AccelView& accel, Vec3f o, Vec3f d, Float t_max, Mask active) {
  const LaneRays rays(o, d, active);
  alignas(64) float t[kLanes];
  store(t, t_max);
  occluded_in_bvh(accel, rays.fields(), kLanes, t);
  return active & (t_max > Float(0.0f)) & (load(t) < Float(0.0f));
}

}  // namespace norrsken::NORRSKEN_ISA
