// bumpmap: host side.
//
// Parameters
//   scale                   number (default 1): factor on the heights
//   flip_invalid_normals    boolean (default true): normals that turn away from the viewer are folded back
//   use_shadowing_function  boolean (default true): softens the edge of the light on bumps
// Children
//   texture                 one bitmap, of any name: heights
//   bsdf                    one: what is bumpy; up to 4 bump and normal maps may stand inside each other, each in the
//                           frame that the one around it makes
// Stored, for each side: the words inside, flags, scale, the texture's word.
#include <fmt/format.h>

#include "bsdf/resolved_host.h"

namespace norrsken {

Material compile_bsdf_bumpmap(Parameters& p, Builder& builder) {
  constexpr double kMaxScale = 1e6;
  const double scale = p.number("scale", 1, -kMaxScale, kMaxScale);
  const Node::Child* child = p.child("texture");
  if (!child) builder.diagnostics().error(p.node().location, "bsdf 'bumpmap' has no texture inside", "one bitmap");
  Texture texture = child ? builder.texture(*child->node) : Texture{};
  if (texture.word != 0 && texture_kind(texture.word) != TextureKind::bitmap) {
    builder.diagnostics().error(child->location, "the texture of a bumpmap has no slopes", "a bitmap");
    texture.word = 0;
  }
  auto blocks = perturbed_blocks(p, builder);
  builder.describe(p.node(), fmt::format("scale {:.3g}", scale));
  if (!blocks || texture.word == 0) return {};
  for (ParameterBlock* block : {&blocks->front, &blocks->back}) block->add(scale).add_word(texture.word);
  return {.front = builder.add_material(BsdfKind::bumpmap, blocks->front),
          .back = builder.add_material(BsdfKind::bumpmap, blocks->back)};
}

}  // namespace norrsken
