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
  float reach;                   ///< corners that are nearer round by less than rays begin off surfaces (kOffsetUlps)
  float t;
  std::uint32_t primitive_side;
  std::uint32_t ray;      ///< its number
  std::uint32_t waiting;  ///< how many children
  alignas(32) std::uint32_t child[kMostWaiting];
  alignas(32) float entry[kMostWaiting];  ///< where the ray meets it, or a little before
};

/// RayState::reach over the origin's largest coordinate. What cross_block() interpolates rounds by some 2^-22 of the corners'
/// distance, and rays begin 2^-18 of their origin off.
inline constexpr float kReachOfOrigin = 4.0f;

inline constexpr std::uint32_t kBoundsOfAxis = 2 * kBvhWidth, kCornersOfAxis = 3 * kBvhWidth;

/// The beginnings of a register's rays, computed together. Field k of lane i is values[k][i], in the order of RayState.
class Beginnings {
 public:
  static constexpr std::uint32_t kFields = 19;

  /// Of the rays from `first` on.
  NORRSKEN_INLINE void prepare(const RaySpan& rays, std::uint32_t first) {
    constexpr float kFar = 1e18f, kSmallest = 1e-18f;
    Float o[3], d[3], size[3], sum(0.0f);
    for (int k = 0; k < 3; ++k) {
      o[k] = load(rays.origin[k] + first), d[k] = load(rays.direction[k] + first);
      size[k] = abs(d[k]);
      sum += abs(o[k]) + size[k];
      store(values_[k], o[k]);
      store(values_[3 + k], Float(1.0f) / copysign(max(size[k], Float(kSmallest)), d[k]));
      const UInt is_negative = shift_right<31>(bits(d[k]));
      store(values_[6 + k], UInt(static_cast<std::uint32_t>(k) * kBoundsOfAxis) + is_negative * UInt(kBvhWidth));
    }
    // The sheared space's third axis is the one that the ray follows most closely, the others come behind it in a circle.
    const Mask along_x = (size[0] >= size[1]) & (size[0] >= size[2]), along_y = size[1] >= size[2];
    const auto turned = [&](const auto& x, const auto& y, const auto& z) {
      return select(along_x, x, select(along_y, y, z));
    };
    const Float dz = turned(d[0], d[1], d[2]), scale = Float(1.0f) / dz;
    store(values_[9], turned(d[1], d[2], d[0]) * scale);
    store(values_[10], turned(d[2], d[0], d[1]) * scale);
    store(values_[11], scale);
    const UInt corners[3] = {UInt(0u), UInt(kCornersOfAxis), UInt(2 * kCornersOfAxis)};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t x = (k + 1) % 3, y = (k + 2) % 3;
      store(values_[12 + k], turned(corners[x], corners[y], corners[k]));
      store(values_[15 + k], turned(o[x], o[y], o[k]));
    }
    store(values_[18], Float(kReachOfOrigin) * max(abs(o[0]), max(abs(o[1]), abs(o[2]))));
    sound_ = to_bits((sum < Float(kFar)) & (abs(dz) > Float(0.0f)) & (load(rays.t + first) > Float(0.0f)));
  }

  /// Whether lane i is a ray at all (no NaN and no overflow has got into it) that something can be nearer than its end.
  bool is_sound(std::uint32_t i) const { return ((sound_ >> i) & 1u) != 0; }

  NORRSKEN_INLINE void copy(std::uint32_t i, RayState& r) const {
    for (int k = 0; k < 3; ++k) {
      r.origin[k] = values_[k][i];
      r.reciprocal[k] = values_[3 + k][i];
      r.near_bounds[k] = __builtin_bit_cast(std::uint32_t, values_[6 + k][i]);
      r.shear[k] = values_[9 + k][i];
      r.corners[k] = __builtin_bit_cast(std::uint32_t, values_[12 + k][i]);
      r.sheared_origin[k] = values_[15 + k][i];
    }
    r.reach = values_[18][i];
  }

 private:
  alignas(64) float values_[kFields][kLanes];
  std::uint32_t sound_ = 0;
};

/// Rays one after the other. The arrays are read in whole registers.
class RaysToStart {
 public:
  RaysToStart(const RaySpan& rays, std::uint32_t root) : rays_(rays), root_(root) {}

  /// False if there is none left.
  NORRSKEN_INLINE bool start_next(RayState& r) {
    while (next_ < rays_.count) {
      const std::uint32_t i = next_++, lane = i % kLanes;
      if (lane == 0) beginnings_.prepare(rays_, i);
      if (!beginnings_.is_sound(lane)) continue;
      beginnings_.copy(lane, r);
      r.ray = i;
      r.t = rays_.t[i];
      r.primitive_side = kBvhNothing;
      r.current = root_;
      r.waiting = 1;
      r.child[0] = kBvhNothing;
      r.entry[0] = -__builtin_inff();
      return true;
    }
    return false;
  }

 private:
  const RaySpan& rays_;
  std::uint32_t root_, next_ = 0;
  Beginnings beginnings_;
};

}  // namespace norrsken::NORRSKEN_ISA
