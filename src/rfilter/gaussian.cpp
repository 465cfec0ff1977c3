// gaussian: a Gaussian that is cut off after four standard deviations, lowered so that it reaches zero there. The filter
// of films that name none.
#include <cmath>

#include "compile/frame_tools.h"
#include "rfilter/filter_host.h"

namespace norrsken {
namespace {

constexpr NumberParameter kStddev{.name = "stddev",
                                  .fallback = 0.5,
                                  .range = above(0, kMaxFilterRadius / 4),
                                  .text = "standard deviation",
                                  .unit = "pixels"};

}  // namespace

FilterRecord compile_rfilter_gaussian(Parameters& p, Array<float>& table) {
  const double stddev = p.read(kStddev);
  const auto gaussian = [stddev](double x) { return std::exp(-x * x / (2 * stddev * stddev)); };
  const double radius = 4 * stddev, end = gaussian(radius);
  return tabulate_filter({[=](double x) { return gaussian(x) - end; }, radius, stddev / 64}, table);
}

}  // namespace norrsken
