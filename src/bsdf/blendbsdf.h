// Model       A mixture of two BSDFs: the second with the probability `weight`, the first otherwise.
// Measure     that of the BSDF chosen
// Source      none needed
// Departures  none in what is expected; the path goes on by one side, as in Mitsuba, and light sampling sees both as two
//             samples, each weighted against its own side
#pragma once

#include "bsdf/resolved.h"

namespace norrsken::NORRSKEN_ISA {

struct BlendBsdf {
  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::blendbsdf;
    NumberSlot weight;
    MaterialWord first, second;
  };

  static NORRSKEN_INLINE UInt behind(const ParameterReader& p, Choice& choice) {
    return choice.take(p.get(&Stored::weight), p.get(&Stored::second), p.get(&Stored::first), p.active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
