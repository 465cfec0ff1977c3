// lanczos: a sinc, the ideal low-pass filter, under a window that is the middle of a wider sinc. It has negative lobes.
//
// Source: Duchon, "Lanczos Filtering in One and Two Dimensions", 1979.
#include <cmath>
#include <numbers>

#include "compile/frame_tools.h"
#include "rfilter/filter_host.h"

namespace norrsken {
namespace {

constexpr IntegerParameter kLobes{.name = "lobes",
                                  .fallback = 3,
                                  .min = 1,
                                  .max = 16,
                                  .text = "the radius, so the sinc's lobes to each side",
                                  .unit = "pixels"};

}  // namespace

FilterRecord compile_rfilter_lanczos(Parameters& p, Array<float>& table) {
  const auto lobes = static_cast<double>(p.read(kLobes));
  const auto sinc = [](double x) { return x < 1e-6 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); };
  return tabulate_filter({[=](double x) { return sinc(x) * sinc(x / lobes); }, lobes, 1.0 / 128}, table);
}

}  // namespace norrsken
