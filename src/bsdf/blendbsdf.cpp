// blendbsdf: host side.
//
// Children
//   bsdf    two
#include "bsdf/blendbsdf.h"

#include <fmt/core.h>

#include "bsdf/resolved_host.h"

namespace norrsken {
namespace {

constexpr NumberParameter kWeight{.name = "weight",
                                  .fallback = 0.5,
                                  .range = kShare,
                                  .text = "share of the second BSDF; the first has the rest",
                                  .example = R"(<float name="weight" value="0.5"/>)",
                                  .beyond = Beyond::is_clamped};

}  // namespace

Material compile_bsdf_blendbsdf(Parameters& p, Materials& materials) {
  const NumberOrTexture weight = materials.read(p, kWeight);
  const auto inside = nested_bsdfs(p, materials, 2);
  materials.describe(p.node(), weight.texture ? "weight from a texture" : fmt::format("weight {:.3g}", weight.value));
  if (inside.empty()) return {};
  const auto side = [&](MaterialWord first, MaterialWord second) {
    return materials.add(isa_host::BlendBsdf::Stored{.weight = weight, .first = first, .second = second});
  };
  return {.front = side(inside[0].front, inside[1].front), .back = side(inside[0].back, inside[1].back)};
}

}  // namespace norrsken
