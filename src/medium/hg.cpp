// hg: host side.
#include "medium/hg.h"

#include "compile/media.h"

namespace norrsken {
namespace {

constexpr NumberParameter kG{.name = "g",
                             .fallback = 0.8,
                             .range = {-1, 1, Ends::open},
                             .text = "mean cosine of the angle of scattering: above 0 forward, below backward"};

}  // namespace

PhaseWord compile_phase_hg(Parameters& p, Media& media) {
  return media.add(isa_host::HenyeyGreenstein::Stored{.g = static_cast<float>(p.read(kG))});
}

}  // namespace norrsken
