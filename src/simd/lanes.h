// Lane types: `Float`, `UInt` and `Mask` hold one value per path, kLanes of them.
//
// Code on them reads like the scalar formula. Rules: a function that takes a mask takes it last, without a default,
// and never looks at an inactive lane's memory. There are no approximate operations (no rcp, no rsqrt): every
// operation is correctly rounded, so two processors with one instruction set give the same bits.
#pragma once

#include "simd/isa_namespace.h"

#if NORRSKEN_LANES == 1
#include "simd/lanes_scalar.h"
#else
#include "simd/lanes_highway.h"
#endif

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE Float fms(Float a, Float b, Float c) { return fma(a, b, -c); }

NORRSKEN_INLINE Float& operator+=(Float& a, Float b) { return a = a + b; }
NORRSKEN_INLINE Float& operator-=(Float& a, Float b) { return a = a - b; }
NORRSKEN_INLINE Float& operator*=(Float& a, Float b) { return a = a * b; }
NORRSKEN_INLINE UInt& operator+=(UInt& a, UInt b) { return a = a + b; }
NORRSKEN_INLINE UInt& operator*=(UInt& a, UInt b) { return a = a * b; }
NORRSKEN_INLINE UInt& operator^=(UInt& a, UInt b) { return a = a ^ b; }
NORRSKEN_INLINE Mask& operator&=(Mask& a, Mask b) { return a = a & b; }
NORRSKEN_INLINE Mask& operator|=(Mask& a, Mask b) { return a = a | b; }

NORRSKEN_INLINE bool none(Mask m) { return !any(m); }

/// Of integers: base[index] in the active lanes.
NORRSKEN_INLINE UInt gather(const std::uint32_t* base, UInt index, Mask m) {
  return gather_uint(reinterpret_cast<const float*>(base), index, m);
}

/// Stores the active lanes one behind the other, at any alignment; up to kLanes values behind p may be overwritten.
NORRSKEN_INLINE void compress_store(float* p, UInt a, const Compaction& c) { compress_store(p, from_bits(a), c); }

/// a where m, zero elsewhere.
NORRSKEN_INLINE Float zero_unless(Mask m, Float a) { return select(m, a, Float(0.0f)); }

}  // namespace norrsken::NORRSKEN_ISA
