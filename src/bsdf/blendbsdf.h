// Model       A mixture of two BSDFs: the second with the probability `weight`, the first otherwise.
// Parameters  weight (number or texture, 0 to 1)
// Measure     that of the BSDF chosen
// Source      none needed
// Departures  Mitsuba chooses where it samples only; the expectation is the same
#pragma once

#include "bsdf/resolved.h"

namespace norrsken::NORRSKEN_ISA {

/// Stored: weight (scalar), then the words of the two.
struct BlendBsdf {
  static NORRSKEN_INLINE UInt behind(const ParameterReader& p, Float& choice) {
    return choose(p.scalar(0), bits(p.number(3)), bits(p.number(2)), choice);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
