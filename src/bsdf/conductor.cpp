// conductor: host side.
//
// Parameters
//   material              string (default "none"): "none" reflects everything; metals are still to come
//   specular_reflectance  color, 0 to 1 (default 1): factor on the reflected light
// Stored: specular reflectance (colour). A factor of exactly 0 is stored as `absorb`.
// Side: the front reflects, the back is black.
#include <fmt/format.h>

#include "base/text.h"
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_conductor(Parameters& p, Builder& builder) {
  const std::string material = p.text("material", "none");
  if (material != "none") {
    p.error("material", fmt::format("conductor material {} is not supported yet", quoted(material)), "none");
  }
  const glm::dvec3 factor = p.color("specular_reflectance", glm::dvec3(1), 0, 1);
  builder.describe(p.node(), fmt::format("specular reflectance {:.3g} {:.3g} {:.3g}", factor.r, factor.g, factor.b));
  if (factor == glm::dvec3(0)) return {};
  return {.front = builder.add_material(BsdfKind::conductor, ParameterBlock().add(ColorParameter{factor}))};
}

}  // namespace norrsken
