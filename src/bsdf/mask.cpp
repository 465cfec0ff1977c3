// mask: host side.
//
// Parameters
//   opacity  number or texture, 0 to 1, else clamped with a warning (default 0.5): share of the light that meets what is inside; the rest passes
// Children
//   bsdf     one: what there is where it is not a hole
// Stored, for each side: opacity (2 floats), the word inside, the word of `null`.
#include <fmt/format.h>

#include "bsdf/resolved_host.h"

namespace norrsken {

Material compile_bsdf_mask(Parameters& p, Builder& builder) {
  const ScalarParameter opacity = builder.share(p, "opacity", 0.5);
  const auto inside = nested_bsdfs(p, builder, 1);
  builder.describe(p.node(), opacity.texture ? "opacity from a texture" : fmt::format("opacity {:.3g}", opacity.value));
  if (inside.empty()) return {};
  const MaterialWord nothing = builder.add_material(BsdfKind::null, ParameterBlock());
  const auto side = [&](MaterialWord word) {
    return builder.add_material(BsdfKind::mask, ParameterBlock().add(opacity).add_word(word).add_word(nothing));
  };
  return {.front = side(inside[0].front), .back = side(inside[0].back)};
}

}  // namespace norrsken
