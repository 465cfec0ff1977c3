// catmullrom: piecewise cubic and sharp; it interpolates. It has negative lobes. No parameters.
//
// Source: Catmull and Rom, "A Class of Local Interpolating Splines", 1974; in the family of Mitchell and Netravali 1988
// it is B = 0, C = 1/2.
#include "compile/frame_tools.h"
#include "rfilter/cubic_host.h"

namespace norrsken {

FilterRecord compile_rfilter_catmullrom(Parameters&, Array<float>& table) {
  return tabulate_filter(cubic_filter(0, 0.5), table);
}

}  // namespace norrsken
