#include "bsdf/dielectric_host.h"

#include <fmt/format.h>

#include "bsdf/ior_host.h"

namespace norrsken {

DielectricMaterial read_dielectric(Parameters& p, Builder& builder) {
  DielectricMaterial d;
  d.eta = read_relative_ior(p, "bk7");
  d.specular_reflectance = builder.color(p, "specular_reflectance", glm::dvec3(1), 0, 1);
  d.specular_transmittance = builder.color(p, "specular_transmittance", glm::dvec3(1), 0, 1);
  d.description = fmt::format("relative index of refraction {:.5g}", d.eta);
  return d;
}

}  // namespace norrsken
