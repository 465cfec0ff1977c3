// A ray on its way through the hierarchy: what its tests need, and the children that it has yet to come back to.
#pragma once

#include "simd/octet.h"
#include "tables/bvh_tables.h"

namespace norrsken::NORRSKEN_ISA {

/// Every level leaves seven children behind at most; whole octets may be written past the last.
inline constexpr std::uint32_t kMostWaiting = (kBvhWidth - 1) * kBvhMostLevels + 1 + 2 * kOctetLanes;

/// Rays as arrays, with what is known of their ends.
struct RaySpan {
  const float* origin[3];
  const float* direction[3];
  /// In: nothing is looked for from there on. Out: of closest hits, where they are; of occlusion, minus infinity where
  /// there was something.
  float* t;
  std::uint32_t* primitive_side;  ///< of closest hits; left as it is where there is none
  std::uint32_t count;
};

struct alignas(64) RayState {
  float origin[3];
  float reciprocal[3];           ///< of the direction
  std::uint32_t near_bounds[3];  ///< where a node's bounds begin that the ray passes first, in floats; those of its far
                                 ///< side are kBvhWidth further or less
  std::uint32_t current;         ///< child
  float shear[3];                ///< turns the direction into the third axis
  std::uint32_t corners[3];      ///< where a block's coordinates begin along the axes of the sheared space, in floats
  float sheared_origin[3];       ///< its coordinates in that order, not sheared
  float t;
  std::uint32_t primitive_side;
  std::uint32_t ray;      ///< its number
  std::uint32_t waiting;  ///< how many children
  alignas(32) std::uint32_t child[kMostWaiting];
  alignas(32) float entry[kMostWaiting];  ///< where the ray meets it, or a little before
};

inline constexpr std::uint32_t kBoundsOfAxis = 2 * kBvhWidth, kCornersOfAxis = 3 * kBvhWidth;

/// False if this is no ray (a NaN or an overflow has got into it) or nothing can be hit.
NORRSKEN_INLINE bool start(RayState& r, const RaySpan& rays, std::uint32_t i, std::uint32_t root) {
  constexpr float kFar = 1e18f, kSmallest = 1e-18f;
  const float o[3] = {rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]};
  const float d[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
  r.ray = i;
  r.t = rays.t[i];
  r.primitive_side = kBvhNothing;
  r.current = root;
  r.waiting = 1;
  r.child[0] = kBvhNothing;
  r.entry[0] = -__builtin_inff();
  float size[3], sum = 0.0f;
  for (int k = 0; k < 3; ++k) {
    size[k] = __builtin_fabsf(d[k]);
    sum += __builtin_fabsf(o[k]) + size[k];
    r.origin[k] = o[k];
    r.reciprocal[k] = 1.0f / __builtin_copysignf(size[k] > kSmallest ? size[k] : kSmallest, d[k]);
    r.near_bounds[k] = static_cast<std::uint32_t>(k) * kBoundsOfAxis + (__builtin_signbit(d[k]) ? kBvhWidth : 0u);
  }
  const std::uint32_t z = size[0] >= size[1] ? (size[0] >= size[2] ? 0u : 2u) : (size[1] >= size[2] ? 1u : 2u);
  const std::uint32_t x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
  r.shear[2] = 1.0f / d[z];
  r.shear[0] = d[x] * r.shear[2], r.shear[1] = d[y] * r.shear[2];
  r.corners[0] = x * kCornersOfAxis, r.corners[1] = y * kCornersOfAxis, r.corners[2] = z * kCornersOfAxis;
  r.sheared_origin[0] = o[x], r.sheared_origin[1] = o[y], r.sheared_origin[2] = o[z];
  return sum < kFar && size[z] > 0.0f && r.t > 0.0f;
}

}  // namespace norrsken::NORRSKEN_ISA
