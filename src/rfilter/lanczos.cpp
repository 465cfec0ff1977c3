// lanczos: a sinc, the ideal low-pass filter, under a window that is the middle of a wider sinc. It has negative lobes.
//
// Parameters
//   lobes  integer, 1 to 16 (default 3): the radius in pixels, so the sinc's lobes to each side
// Source: Duchon, "Lanczos Filtering in One and Two Dimensions", 1979.
#include <cmath>
#include <numbers>

#include "compile/plugins.h"
#include "rfilter/filter_host.h"

namespace norrsken {

FilterRecord compile_rfilter_lanczos(Parameters& p, Builder& builder) {
  const auto lobes = static_cast<double>(p.integer("lobes", 3, 1, 16));
  const auto sinc = [](double x) { return x < 1e-6 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); };
  return tabulate_filter({[=](double x) { return sinc(x) * sinc(x / lobes); }, lobes, 1.0 / 128},
                         builder.tables().filter);
}

}  // namespace norrsken
