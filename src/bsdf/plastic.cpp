// plastic: host side.
//
// Parameters
//   diffuse_reflectance   color or texture, 0 to 1 (default 0.5): of the base below the coat
//   specular_reflectance  color or texture, 0 to 1 (default 1): factor on the light that the coat reflects
//   int_ior, ext_ior      float greater than 0, or a material's name (defaults "polypropylene" and "air"): indices of
//                         refraction inside and outside
//   nonlinear             boolean (default false): light that the coat sends back is coloured by the base once more
// Stored: what coat.h lists.
// Side: the front scatters, the back is black; `twosided` makes both scatter.
#include "bsdf/coat_host.h"
#include "bsdf/fresnel_host.h"
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_plastic(Parameters& p, Builder& builder) {
  const CoatMaterial coat = read_coat(p, builder);
  builder.describe(p.node(), coat.description);
  const double from_inside = fresnel_diffuse_reflectance(1 / coat.eta);
  return {.front = builder.add_material(BsdfKind::plastic, coat_block(coat, from_inside))};
}

}  // namespace norrsken
