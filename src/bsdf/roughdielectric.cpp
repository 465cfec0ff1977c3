// roughdielectric: host side.
//
// Parameters
//   int_ior, ext_ior, specular_reflectance, specular_transmittance   as in `dielectric`; the indices must differ
//   distribution    "beckmann" (default) or "ggx"
//   alpha           float or texture, 0 to 100 (default 0.1): roughness, the root mean square slope of the facets
//   alpha_u, alpha_v  the same along u and v of the texture coordinates, both or none
//   sample_visible  boolean: accepted; visible normals are sampled either way
// Stored: specular reflectance, specular transmittance (colours), alpha_u, alpha_v (scalars), 1 for ggx, relative index
// of refraction.
// Side: both; the back has the inverse index.
#include "bsdf/dielectric_host.h"
#include "bsdf/microfacet_host.h"
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_roughdielectric(Parameters& p, Builder& builder) {
  const DielectricMaterial d = read_dielectric(p, builder);
  const Roughness r = read_roughness(p, builder);
  builder.describe(p.node(), d.description + ", " + describe_roughness(r));
  if (d.eta == 1) {
    p.error(p.has("int_ior") ? "int_ior" : "ext_ior", "the indices of refraction of both sides are the same",
            "int_ior and ext_ior that differ");
  }
  const auto side = [&](double eta) {
    ParameterBlock block;
    block.add(d.specular_reflectance).add(d.specular_transmittance);
    add_roughness(block, r);
    return builder.add_material(BsdfKind::roughdielectric, block.add(eta));
  };
  return {.front = side(d.eta), .back = side(1 / d.eta)};
}

}  // namespace norrsken
