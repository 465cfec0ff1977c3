// gaussian: a Gaussian that is cut off after four standard deviations, lowered so that it reaches zero there. The filter
// of films that name none.
//
// Parameters
//   stddev  number above 0 and at most 25, pixels (default 0.5): standard deviation
#include <cmath>

#include "compile/plugins.h"
#include "rfilter/filter_host.h"

namespace norrsken {

FilterRecord compile_rfilter_gaussian(Parameters& p, Builder& builder) {
  const double stddev = p.number("stddev", 0.5, 0, kMaxFilterRadius / 4, Ends::open_below);
  const auto gaussian = [stddev](double x) { return std::exp(-x * x / (2 * stddev * stddev)); };
  const double radius = 4 * stddev, end = gaussian(radius);
  return tabulate_filter({[=](double x) { return gaussian(x) - end; }, radius, stddev / 64}, builder.tables().filter);
}

}  // namespace norrsken
