// dielectric: host side.
//
// Parameters
//   int_ior  float or string (default "bk7"): index of refraction on the side that the normal points away from
//   ext_ior  float or string (default "air"): the same on the side of the normal
//   specular_reflectance, specular_transmittance  color or texture, 0 to 1 (default 1): factors on either part
// Stored: specular reflectance, specular transmittance (colours), relative index of refraction.
// Side: both; the back has the inverse index.
//
// Materials by name, in any case: vacuum, helium, hydrogen, air, carbon dioxide; water, acetone, ethanol, carbon
// tetrachloride, glycerol, benzene, silicone oil, bromine; water ice, fused quartz, pyrex, acrylic glass,
// polypropylene, bk7, sodium chloride, amber, pet, diamond.
#include "bsdf/dielectric_host.h"
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_dielectric(Parameters& p, Builder& builder) {
  const DielectricMaterial d = read_dielectric(p, builder);
  builder.describe(p.node(), d.description);
  const auto side = [&](double eta) {
    const ParameterBlock block = ParameterBlock().add(d.specular_reflectance).add(d.specular_transmittance).add(eta);
    return builder.add_material(BsdfKind::dielectric, block);
  };
  return {.front = side(d.eta), .back = side(1 / d.eta)};
}

}  // namespace norrsken
