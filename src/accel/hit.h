// What an intersector answers.
#pragma once

#include "math/vec3.h"
#include "tables/scene_tables.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr float kInfinity = __builtin_inff();

/// Bit 31 of `primitive_side` says that the surface was hit from the side its normal does not point to; the rest is
/// the primitive. Where nothing was hit, `t` is what the search began with.
struct ClosestHit {
  Float t;
  UInt primitive_side;
};

inline constexpr std::uint32_t kBackSide = 0x80000000u;
inline constexpr std::uint32_t kPrimitiveMask = 0x7fffffffu;

}  // namespace norrsken::NORRSKEN_ISA
