// Text files of curves, read for either basis.
#include "formats/curves.h"

#include <algorithm>
#include <cmath>

#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  for (const CurveBasis basis : {CurveBasis::linear, CurveBasis::bspline}) {
    Diagnostics diagnostics;
    const auto curves = read_curves(fuzz::text_of(data, size), basis, "input.txt", diagnostics);
    fuzz::check_complaints(curves.has_value(), diagnostics);
    if (!curves) continue;
    fuzz::require(curves->curves >= 1 && curves->curves <= curves->segments.size(), "every curve has a segment");
    for (const std::uint32_t first : curves->segments) {
      fuzz::require(first + static_cast<std::size_t>(basis) <= curves->points.size(), "segments have their points");
    }
    for (const auto& point : curves->points) {
      fuzz::require(std::ranges::all_of(point, [](float v) { return std::isfinite(v); }), "points are finite");
    }
  }
  return 0;
}
