// conductor: host side.
//
// Side: the front reflects, the back is black; `twosided` makes both reflect.
//
// Materials by name: a-C, Ag, Al, AlAs, AlSb, Au, Be, Cr, CsI, Cu, Cu2O, CuO, d-C, Hg, HgTe, Ir, K, Li, MgO, Mo,
// Na_palik, Nb, Ni_palik, Rh, Se, Se-e, SiC, SnTe, Ta, Te, Te-e, ThF4, TiC, TiN, TiO2, TiO2-e, V_palik, VC, VN, W; most
// of them also with _palik behind, as in Mitsuba.
#include "bsdf/conductor.h"

#include "bsdf/conductor_host.h"

namespace norrsken {

Material compile_bsdf_conductor(Parameters& p, Materials& materials) {
  const ConductorMaterial c = read_conductor(p, materials);
  materials.describe(p.node(), c.description);
  if (c.specular_reflectance.is_black()) return {};
  using Stored = isa_host::Conductor::Stored;
  return {.front = materials.add(Stored{.specular_reflectance = c.specular_reflectance, .eta = c.eta, .k = c.k})};
}

}  // namespace norrsken
