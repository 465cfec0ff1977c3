// diffuse: host side.
//
// Side: the front scatters, the back is black; `twosided` makes both scatter.
#include "bsdf/diffuse.h"

#include <fmt/core.h>

#include "compile/materials.h"

namespace norrsken {
namespace {

using Stored = isa_host::Diffuse::Stored;

constexpr ColorParameter kReflectance{.name = "reflectance",
                                      .fallback = 0.5,
                                      .range = kShare,
                                      .text = "share of the arriving light that is scattered back"};

}  // namespace

Material default_material(Materials& materials) {
  return {.front = materials.add(Stored{.reflectance = ColorOrTexture{SceneColor(kReflectance.fallback)}})};
}

Material compile_bsdf_diffuse(Parameters& p, Materials& materials) {
  const ColorOrTexture reflectance = materials.read(p, kReflectance);
  const glm::dvec3 rgb = reflectance.rgb();
  materials.describe(p.node(), fmt::format("reflectance {:.3g} {:.3g} {:.3g}", rgb.r, rgb.g, rgb.b));
  if (reflectance.is_black()) return {};
  return {.front = materials.add(Stored{.reflectance = reflectance})};
}

}  // namespace norrsken
