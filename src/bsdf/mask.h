// Model       A surface with holes: the BSDF inside with the probability `opacity`, nothing otherwise.
// Measure     that of the BSDF inside, or delta
// Source      none needed
// Departures  none in what is expected; the path goes on by one side, as in Mitsuba, and light sampling sees both as two
//             samples, each weighted against its own side
#pragma once

#include "bsdf/resolved.h"

namespace norrsken::NORRSKEN_ISA {

struct MaskBsdf {
  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::mask;
    NumberSlot opacity;
    MaterialWord inside, nothing;
  };

  static NORRSKEN_INLINE UInt behind(const ParameterReader& p, Choice& choice) {
    return choice.take(p.get(&Stored::opacity), p.get(&Stored::inside), p.get(&Stored::nothing), p.active);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
