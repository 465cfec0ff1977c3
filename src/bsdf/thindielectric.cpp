// thindielectric: host side.
//
// Parameters
//   int_ior  float or string (default "bk7"): index of refraction of the sheet
//   ext_ior  float or string (default "air"): of what is on both sides of it
//   specular_reflectance, specular_transmittance  color or texture, 0 to 1 (default 1): factors on either part
// Stored: specular reflectance, specular transmittance (colours), relative index of refraction.
// Side: both alike.
#include "bsdf/dielectric_host.h"
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_thindielectric(Parameters& p, Builder& builder) {
  const DielectricMaterial d = read_dielectric(p, builder);
  builder.describe(p.node(), d.description);
  const ParameterBlock block = ParameterBlock().add(d.specular_reflectance).add(d.specular_transmittance).add(d.eta);
  const MaterialWord word = builder.add_material(BsdfKind::thindielectric, block);
  return {.front = word, .back = word};
}

}  // namespace norrsken
