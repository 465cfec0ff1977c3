// mitchell: piecewise cubic, between blurring and ringing. It has negative lobes.
//
// Parameters
//   B, C  numbers from 0 to 1 (default 1/3 each)
// Source: Mitchell and Netravali, "Reconstruction Filters in Computer Graphics", 1988, equation 8.
#include "compile/plugins.h"
#include "rfilter/cubic_host.h"

namespace norrsken {

FilterRecord compile_rfilter_mitchell(Parameters& p, Builder& builder) {
  const double b = p.number("B", 1.0 / 3, 0, 1), c = p.number("C", 1.0 / 3, 0, 1);
  return tabulate_filter(cubic_filter(b, c), builder.tables().filter);
}

}  // namespace norrsken
