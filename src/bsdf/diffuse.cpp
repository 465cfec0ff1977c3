// diffuse: host side.
//
// Parameters
//   reflectance  color or texture, 0 to 1 (default 0.5): share of the arriving light that is scattered back
// Stored: reflectance (colour). A reflectance of exactly 0 is stored as `absorb`, which costs nothing to shade.
// Side: the front scatters, the back is black; `twosided` makes both scatter.
#include <fmt/format.h>

#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_diffuse(Parameters& p, Builder& builder) {
  const ColorParameter color = builder.color(p, "reflectance", glm::dvec3(0.5), 0, 1);
  const glm::dvec3 reflectance = color.value;
  builder.describe(p.node(),
                   fmt::format("reflectance {:.3g} {:.3g} {:.3g}", reflectance.r, reflectance.g, reflectance.b));
  if (reflectance == glm::dvec3(0) && color.texture == 0) return {};
  return {.front = builder.add_material(BsdfKind::diffuse, ParameterBlock().add(color))};
}

}  // namespace norrsken
