// tent: falls off linearly from the pixel's centre.
//
// Parameters
//   radius  number above 0 and at most 100, pixels (default 1): where the filter reaches zero
#include "compile/plugins.h"
#include "rfilter/filter_host.h"

namespace norrsken {

FilterRecord compile_rfilter_tent(Parameters& p, Builder& builder) {
  const double radius = p.number("radius", 1, 0, kMaxFilterRadius, Ends::open_below);
  return tabulate_filter({[radius](double x) { return 1 - x / radius; }, radius, radius}, builder.tables().filter);
}

}  // namespace norrsken
