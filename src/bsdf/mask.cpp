// mask: host side.
//
// Children
//   bsdf     one: what there is where it is not a hole
#include "bsdf/mask.h"

#include <fmt/core.h>

#include "bsdf/resolved_host.h"

namespace norrsken {
namespace {

constexpr NumberParameter kOpacity{.name = "opacity",
                                   .fallback = 0.5,
                                   .range = kShare,
                                   .text = "share of the light that meets what is inside; the rest passes",
                                   .beyond = Beyond::is_clamped};

}  // namespace

Material compile_bsdf_mask(Parameters& p, Materials& materials) {
  const NumberOrTexture opacity = materials.read(p, kOpacity);
  const auto inside = nested_bsdfs(p, materials, 1);
  materials.describe(p.node(),
                     opacity.texture ? "opacity from a texture" : fmt::format("opacity {:.3g}", opacity.value));
  if (inside.empty()) return {};
  const MaterialWord nothing = materials.add(BsdfKind::null);
  const auto side = [&](MaterialWord word) {
    return materials.add(isa_host::MaskBsdf::Stored{.opacity = opacity, .inside = word, .nothing = nothing});
  };
  return {.front = side(inside[0].front), .back = side(inside[0].back)};
}

}  // namespace norrsken
