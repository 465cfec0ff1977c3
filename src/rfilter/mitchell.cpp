// mitchell: piecewise cubic, between blurring and ringing. It has negative lobes.
//
// Source: Mitchell and Netravali, "Reconstruction Filters in Computer Graphics", 1988, equation 8.
#include "compile/frame_tools.h"
#include "rfilter/cubic_host.h"

namespace norrsken {
namespace {

constexpr NumberParameter kB{.name = "B", .fallback = 1.0 / 3, .range = kShare};
constexpr NumberParameter kC{.name = "C", .fallback = 1.0 / 3, .range = kShare};

}  // namespace

FilterRecord compile_rfilter_mitchell(Parameters& p, Array<float>& table) {
  const double b = p.read(kB), c = p.read(kC);
  return tabulate_filter(cubic_filter(b, c), table);
}

}  // namespace norrsken
