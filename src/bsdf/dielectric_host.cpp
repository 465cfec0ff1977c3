#include "bsdf/dielectric_host.h"

#include <fmt/core.h>

namespace norrsken {
namespace {

constexpr ColorParameter kSpecularReflectance{
    .name = "specular_reflectance", .fallback = 1, .range = kShare, .text = "factor on the reflected light"};
constexpr ColorParameter kSpecularTransmittance{
    .name = "specular_transmittance", .fallback = 1, .range = kShare, .text = "factor on the light that passes"};

}  // namespace

DielectricMaterial read_dielectric(Parameters& p, Materials& materials, const IorParameter& inside,
                                   const IorParameter& outside) {
  DielectricMaterial d;
  d.eta = read_relative_ior(p, inside, outside);
  d.specular_reflectance = materials.read(p, kSpecularReflectance);
  d.specular_transmittance = materials.read(p, kSpecularTransmittance);
  d.description = fmt::format("relative index of refraction {:.5g}", d.eta);
  return d;
}

}  // namespace norrsken
