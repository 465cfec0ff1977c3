// Model       A surface with holes: the BSDF inside with the probability `opacity`, nothing otherwise.
// Parameters  opacity (number or texture, 0 to 1, default 0.5)
// Measure     that of the BSDF inside, or delta
// Source      none needed
// Departures  none in what is expected; the path goes on by one side, as in Mitsuba, and light sampling sees both as two
//             samples, each weighted against its own side
#pragma once

#include "bsdf/resolved.h"

namespace norrsken::NORRSKEN_ISA {

/// Stored: opacity (scalar), then the words of what is inside and of nothing.
struct MaskBsdf {
  static NORRSKEN_INLINE UInt behind(const ParameterReader& p, Choice& choice) {
    return choice.take(p.scalar(0), bits(p.number(2)), bits(p.number(3)), p.active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
