// roughdielectric: host side.
//
// Side: both; the back has the inverse index.
#include "bsdf/roughdielectric.h"

#include "bsdf/dielectric_host.h"
#include "bsdf/microfacet_host.h"

namespace norrsken {
namespace {

constexpr IorParameter kInside{.name = "int_ior",
                               .fallback = "bk7",
                               .text =
                                   "index of refraction on the side that the normal points away from, or a material's "
                                   "name (default \"bk7\"); it must differ from ext_ior"};
constexpr IorParameter kOutside{
    .name = "ext_ior", .fallback = "air", .text = "the same on the side of the normal (default \"air\")"};

}  // namespace

Material compile_bsdf_roughdielectric(Parameters& p, Materials& materials) {
  const DielectricMaterial d = read_dielectric(p, materials, kInside, kOutside);
  const Roughness r = read_roughness(p, materials);
  materials.describe(p.node(), d.description + ", " + describe_roughness(r));
  if (d.eta == 1) refuse_same_ior(p, kInside, kOutside);
  const auto side = [&](double eta) {
    return materials.add(isa_host::RoughDielectric::Stored{.specular_reflectance = d.specular_reflectance,
                                                           .specular_transmittance = d.specular_transmittance,
                                                           .facets = roughness_slots(r),
                                                           .eta = static_cast<float>(eta)});
  };
  return {.front = side(d.eta), .back = side(1 / d.eta)};
}

}  // namespace norrsken
