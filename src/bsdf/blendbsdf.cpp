// blendbsdf: host side.
//
// Parameters
//   weight  number or texture, 0 to 1, else clamped with a warning (required): share of the second BSDF; the first has the rest
// Children
//   bsdf    two
// Stored, for each side: weight (2 floats), the words of the two.
#include <fmt/format.h>

#include "bsdf/resolved_host.h"

namespace norrsken {

Material compile_bsdf_blendbsdf(Parameters& p, Builder& builder) {
  p.require("weight", "<float name=\"weight\" value=\"0.5\"/>");
  const ScalarParameter weight = builder.share(p, "weight", 0.5);
  const auto inside = nested_bsdfs(p, builder, 2);
  builder.describe(p.node(), weight.texture ? "weight from a texture" : fmt::format("weight {:.3g}", weight.value));
  if (inside.empty()) return {};
  const auto side = [&](MaterialWord first, MaterialWord second) {
    return builder.add_material(BsdfKind::blendbsdf, ParameterBlock().add(weight).add_word(first).add_word(second));
  };
  return {.front = side(inside[0].front, inside[1].front), .back = side(inside[0].back, inside[1].back)};
}

}  // namespace norrsken
