// normalmap: host side.
//
// Children
//   bsdf                    one: what has these normals; up to 4 bump and normal maps may stand inside each other, each in the
//                           frame that the one around it makes
#include "bsdf/normalmap.h"

#include "bsdf/resolved_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kNormals{.name = "normalmap",
                                  .text =
                                      "normals in the shading frame, x, y, z from -1 to 1 as colours from 0 to 1. A "
                                      "bitmap wants `raw`",
                                  .example = R"(<texture name="normalmap" type="bitmap">)"};

}  // namespace

Material compile_bsdf_normalmap(Parameters& p, Materials& materials) {
  const ColorOrTexture normals = materials.read(p, kNormals);
  const auto slots = perturbed_slots(p, materials);
  materials.describe(p.node(), {});
  if (!slots) return {};
  const auto side = [&](const isa_host::PerturbedSlots& around) {
    return materials.add(isa_host::NormalMap::Stored{.around = around, .normals = normals});
  };
  return {.front = side(slots->front), .back = side(slots->back)};
}

}  // namespace norrsken
