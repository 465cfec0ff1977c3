// Model       A mixture of two BSDFs: the second with the probability `weight`, the first otherwise.
// Parameters  weight (number or texture, 0 to 1)
// Measure     that of the BSDF chosen
// Source      none needed
// Departures  none in what is expected; the path goes on by one side, as in Mitsuba, and light sampling sees both as two
//             samples, each weighted against its own side
#pragma once

#include "bsdf/resolved.h"

namespace norrsken::NORRSKEN_ISA {

/// Stored: weight (scalar), then the words of the two.
struct BlendBsdf {
  static NORRSKEN_INLINE UInt behind(const ParameterReader& p, Choice& choice) {
    return choice.take(p.scalar(0), bits(p.number(3)), bits(p.number(2)), p.active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
