// roughconductor: host side.
//
// Side: the front reflects, the back is black; `twosided` makes both reflect.
#include "bsdf/roughconductor.h"

#include "bsdf/conductor_host.h"
#include "bsdf/microfacet_host.h"

namespace norrsken {

Material compile_bsdf_roughconductor(Parameters& p, Materials& materials) {
  const ConductorMaterial c = read_conductor(p, materials);
  const Roughness r = read_roughness(p, materials);
  materials.describe(p.node(), c.description + ", " + describe_roughness(r));
  if (c.specular_reflectance.is_black()) return {};
  using Stored = isa_host::RoughConductor::Stored;
  return {.front = materials.add(Stored{
              .specular_reflectance = c.specular_reflectance, .eta = c.eta, .k = c.k, .facets = roughness_slots(r)})};
}

}  // namespace norrsken
