// tent: falls off linearly from the pixel's centre.
#include "compile/frame_tools.h"
#include "rfilter/filter_host.h"

namespace norrsken {
namespace {

constexpr NumberParameter kRadius{.name = "radius",
                                  .fallback = 1,
                                  .range = above(0, kMaxFilterRadius),
                                  .text = "where the filter reaches zero",
                                  .unit = "pixels"};

}  // namespace

FilterRecord compile_rfilter_tent(Parameters& p, Array<float>& table) {
  const double radius = p.read(kRadius);
  return tabulate_filter({[radius](double x) { return 1 - x / radius; }, radius, radius}, table);
}

}  // namespace norrsken
