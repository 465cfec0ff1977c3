// blendphase: two phase functions, of which each scatters its share of the light.
//
// Children
//   phase    two
#include <fmt/core.h>

#include "compile/media.h"
#include "medium/medium_host.h"

namespace norrsken {
namespace {

constexpr NumberParameter kWeight{.name = "weight",
                                  .fallback = 0.5,
                                  .range = kShare,
                                  .text = "share of the second; the first has the rest",
                                  .example = R"(<float name="weight" value="0.5"/>)",
                                  .beyond = Beyond::is_clamped};

}  // namespace

PhaseWord compile_phase_blendphase(Parameters& p, Media& media) {
  PhaseBlend blend{.weight = 0, .volume = kNone, .first = 0, .second = 0};
  if (const Node::Child* child = p.volume(kWeight.name)) {
    const Volume volume = media.volume(*child->node);
    warn_beyond(p, kWeight.name, volume, kWeight.range);
    blend.volume = volume.index;
  } else {
    blend.weight = static_cast<float>(p.read(kWeight));
  }
  const auto phases = p.children("phase");
  if (phases.size() != 2) {
    p.diagnostics().error(
        p.node().location,
        fmt::format("a blendphase with {} phase function{}", phases.size(), phases.size() == 1 ? "" : "s"), "two");
    return 0;
  }
  blend.first = media.phase(*phases[0]->node), blend.second = media.phase(*phases[1]->node);
  for (const Node::Child* child : phases) {
    if (child->node->plugin == "sggx")
      p.diagnostics().error(child->location, "an sggx stands in a blendphase",
                            "an sggx as the phase function of a medium");
  }
  return media.add(blend);
}

}  // namespace norrsken
