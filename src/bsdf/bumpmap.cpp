// bumpmap: host side.
//
// Children
//   texture                 one bitmap, of any name: heights
//   bsdf                    one: what is bumpy; up to 4 bump and normal maps may stand inside each other, each in the
//                           frame that the one around it makes
#include "bsdf/bumpmap.h"

#include <fmt/core.h>

#include "bsdf/resolved_host.h"

namespace norrsken {
namespace {

constexpr NumberParameter kScale{.name = "scale", .fallback = 1, .range = {-1e6, 1e6}, .text = "factor on the heights"};

}  // namespace

Material compile_bsdf_bumpmap(Parameters& p, Materials& materials) {
  const double scale = p.read(kScale);
  const Node::Child* child = p.child("texture");
  if (!child) p.diagnostics().error(p.node().location, "bsdf 'bumpmap' has no texture inside", "one bitmap");
  Texture texture = child ? materials.texture(*child->node) : Texture{};
  if (texture.word != 0 && texture_kind(texture.word) != TextureKind::bitmap) {
    p.diagnostics().error(child->location, "the texture of a bumpmap has no slopes", "a bitmap");
    texture.word = 0;
  }
  const auto slots = perturbed_slots(p, materials);
  materials.describe(p.node(), fmt::format("scale {:.3g}", scale));
  if (!slots || texture.word == 0) return {};
  const auto side = [&](const isa_host::PerturbedSlots& around) {
    return materials.add(
        isa_host::BumpMap::Stored{.around = around, .scale = static_cast<float>(scale), .texture = texture.word});
  };
  return {.front = side(slots->front), .back = side(slots->back)};
}

}  // namespace norrsken
