// Model       Independent, uniformly distributed random numbers: a hash of (pixel, sample, dimension).
// Parameters  none
// Source      counter-based generation after Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3", 2011, with
//             the 32-bit finaliser of hash.h: a bijection of the sample index for each pixel and dimension.
// Departures  none
#pragma once

#include "math/warp.h"
#include "sampler/hash.h"

namespace norrsken::NORRSKEN_ISA {

struct IndependentSampler {
  /// `key` is unique to the sample within its pixel.
  static NORRSKEN_INLINE Float sample_1d(UInt key, std::uint32_t dimension) {
    return to_unit(hash(key + UInt(dimension * 0x9e3779b9u)));
  }
  static NORRSKEN_INLINE Vec2f sample_2d(UInt key, std::uint32_t dimension) {
    return {sample_1d(key, dimension), sample_1d(key, dimension + 1)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
