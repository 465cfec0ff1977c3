// Model       No scattering: everything that arrives is absorbed. Lights of reflectance 0, backs of one-sided surfaces.
// Parameters  none
// Measure     none
// Source      -
// Departures  only the feature layers ever shade it; light transport ends here before
#pragma once

#include "bsdf/bsdf.h"

namespace norrsken::NORRSKEN_ISA {

struct Absorb {
  struct Parameters {};
  static NORRSKEN_INLINE Parameters load(const ParameterReader&) { return {}; }
  static NORRSKEN_INLINE Color albedo(const Parameters&) { return black(); }
};

}  // namespace norrsken::NORRSKEN_ISA
