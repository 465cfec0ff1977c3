// What an intersector answers.
#pragma once

#include "math/gather.h"
#include "tables/scene_tables.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr float kInfinity = __builtin_inff();

/// Bit 31 of `primitive_side` says that the surface was hit from the side its normal does not point to; the rest is
/// the primitive. `instance` is the one that the primitive was hit in, or kNone. Where nothing was hit, `t` is what the
/// search began with.
struct ClosestHit {
  Float t;
  UInt primitive_side;
  UInt instance = kNone;
};

NORRSKEN_INLINE ClosestHit no_hit() { return {kInfinity, 0u}; }

inline constexpr std::uint32_t kBackSide = 0x80000000u;
inline constexpr std::uint32_t kPrimitiveMask = 0x7fffffffu;

/// Where the instances stand, for lanes with one.
NORRSKEN_INLINE Affine object_from_world(const InstanceRecord* instances, UInt instance, Mask active) {
  return gather(instances, &InstanceRecord::place, &Placement::local_from_world, instance, active);
}
NORRSKEN_INLINE Affine world_from_object(const InstanceRecord* instances, UInt instance, Mask active) {
  return gather(instances, &InstanceRecord::place, &Placement::world_from_local, instance, active);
}

/// Whether these are rays at all: no NaN and no overflow of a model has got into them.
NORRSKEN_INLINE Mask is_ray(const Vec3f& o, const Vec3f& d) {
  constexpr float kFar = 1e18f;  // Embree, built with its checks, ends the program beyond 1.8e18
  return abs(o.x) + abs(o.y) + abs(o.z) + abs(d.x) + abs(d.y) + abs(d.z) < kFar;
}

}  // namespace norrsken::NORRSKEN_ISA
