// twosided: gives a one-sided BSDF a back.
//
// Children
//   bsdf   one or two: the first is seen from the front; the second, or else the first again, from the back
// The back is shaded like a front whose normal is turned towards the viewer. A bump or normal map inside is mirrored with
// it: its hills are hills from both sides. Those of a map around are hollows from behind. Both as in Mitsuba.
#include "compile/materials.h"

namespace norrsken {

Material compile_bsdf_twosided(Parameters& p, Materials& materials) {
  const auto sides = p.children("bsdf");
  materials.describe(p.node(), {});
  if (sides.empty() || sides.size() > 2) {
    p.diagnostics().error(
        sides.empty() ? p.node().location : sides[2]->location,
        sides.empty() ? "bsdf 'twosided' has no bsdf inside" : "bsdf 'twosided' has more than two bsdfs inside",
        "one bsdf for both sides, or one for the front and one for the back");
    return {};
  }
  return {.front = materials.inside(*sides.front()->node).front, .back = materials.inside(*sides.back()->node).front};
}

}  // namespace norrsken
