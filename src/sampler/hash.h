// Integer hashing in lanes.
#pragma once

#include "simd/lanes.h"

namespace norrsken::NORRSKEN_ISA {

/// A bijection of 32-bit words in which every input bit reaches every output bit.
/// Source: Wellons, "Prospecting for Hash Functions" (lowbias32), 2018.
NORRSKEN_INLINE UInt hash(UInt x) {
  x ^= shift_right<16>(x);
  x *= UInt(0x7feb352du);
  x ^= shift_right<15>(x);
  x *= UInt(0x846ca68bu);
  x ^= shift_right<16>(x);
  return x;
}

/// Two words into one.
NORRSKEN_INLINE UInt hash(UInt a, UInt b) { return hash(hash(a) + b * UInt(0x9e3779b9u)); }

/// The top 24 bits as a number in [0, 1).
NORRSKEN_INLINE Float to_unit(UInt x) { return to_float(shift_right<8>(x)) * 0x1p-24f; }

}  // namespace norrsken::NORRSKEN_ISA
