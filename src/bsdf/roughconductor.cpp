// roughconductor: host side.
//
// Parameters
//   material, eta, k, specular_reflectance   as in `conductor`
//   distribution    "beckmann" (default) or "ggx"
//   alpha           float or texture, 0 to 100 (default 0.1): roughness, the root mean square slope of the facets
//   alpha_u, alpha_v  the same along u and v of the texture coordinates, both or none
//   sample_visible  boolean: accepted; visible normals are sampled either way
// Stored: specular reflectance, eta, k (colours), alpha_u, alpha_v (scalars), 1 for ggx. A
// specular reflectance of exactly 0 is stored as `absorb`.
// Side: the front reflects, the back is black; `twosided` makes both reflect.
#include "bsdf/conductor_host.h"
#include "bsdf/microfacet_host.h"
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_roughconductor(Parameters& p, Builder& builder) {
  const ConductorMaterial c = read_conductor(p, builder);
  const Roughness r = read_roughness(p, builder);
  builder.describe(p.node(), c.description + ", " + describe_roughness(r));
  if (c.reflects_nothing()) return {};
  ParameterBlock block;
  block.add(c.specular_reflectance).add(c.eta).add(c.k);
  add_roughness(block, r);
  return {.front = builder.add_material(BsdfKind::roughconductor, block)};
}

}  // namespace norrsken
