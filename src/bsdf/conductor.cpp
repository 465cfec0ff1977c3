// conductor: host side.
//
// Parameters
//   material              string (default "none"): a conductor by name, from the table of measured ones; "none"
//                         reflects everything
//   eta, k                color or texture, from 0 (default 0 and 1, which is "none"): real and imaginary part of the
//                         index of refraction, over that of the surroundings; instead of a material
//   specular_reflectance  color or texture, 0 to 1 (default 1): factor on the reflected light
// Stored: specular reflectance, eta, k (colours). A specular reflectance of exactly 0 is stored as `absorb`.
// Side: the front reflects, the back is black; `twosided` makes both reflect.
//
// Materials by name: a-C, Ag, Al, AlAs, AlSb, Au, Be, Cr, CsI, Cu, Cu2O, CuO, d-C, Hg, HgTe, Ir, K, Li, MgO, Mo,
// Na_palik, Nb, Ni_palik, Rh, Se, Se-e, SiC, SnTe, Ta, Te, Te-e, ThF4, TiC, TiN, TiO2, TiO2-e, V_palik, VC, VN, W; most
// of them also with _palik behind, as in Mitsuba.
#include "bsdf/conductor_host.h"
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_conductor(Parameters& p, Builder& builder) {
  const ConductorMaterial c = read_conductor(p, builder);
  builder.describe(p.node(), c.description);
  if (c.reflects_nothing()) return {};
  const ParameterBlock block = ParameterBlock().add(c.specular_reflectance).add(c.eta).add(c.k);
  return {.front = builder.add_material(BsdfKind::conductor, block)};
}

}  // namespace norrsken
