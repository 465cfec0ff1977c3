// Model       Independent, uniformly distributed random numbers: a hash of (pixel, sample, dimension).
// Parameters  none
// Source      counter-based generation after Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3", 2011, with
//             the 32-bit finaliser of hash.h, over a Weyl sequence whose start and step are the sample's.
// Departures  none
#pragma once

#include "math/warp.h"
#include "sampler/hash.h"

namespace norrsken::NORRSKEN_ISA {

struct IndependentSampler {
  /// `key` is unique to the sample within its pixel; `step`, an odd number, walks through the dimensions. With 63 bits
  /// in all, no two samples of an image get the same numbers.
  static NORRSKEN_INLINE Float sample_1d(UInt key, UInt step, std::uint32_t dimension) {
    return to_unit(hash(key + step * UInt(dimension + 1)));
  }
  static NORRSKEN_INLINE Vec2f sample_2d(UInt key, UInt step, std::uint32_t dimension) {
    return {sample_1d(key, step, dimension), sample_1d(key, step, dimension + 1)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
