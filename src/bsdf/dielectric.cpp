// dielectric: host side.
//
// Side: both; the back has the inverse index.
//
// Materials by name, in any case: vacuum, helium, hydrogen, air, carbon dioxide; water, acetone, ethanol, carbon
// tetrachloride, glycerol, benzene, silicone oil, bromine; water ice, fused quartz, pyrex, acrylic glass,
// polypropylene, bk7, sodium chloride, amber, pet, diamond.
#include "bsdf/dielectric.h"

#include "bsdf/dielectric_host.h"

namespace norrsken {
namespace {

constexpr IorParameter kInside{
    .name = "int_ior",
    .fallback = "bk7",
    .text = "index of refraction on the side that the normal points away from, or a material's name (default \"bk7\")"};
constexpr IorParameter kOutside{
    .name = "ext_ior", .fallback = "air", .text = "the same on the side of the normal (default \"air\")"};

}  // namespace

Material compile_bsdf_dielectric(Parameters& p, Materials& materials) {
  const DielectricMaterial d = read_dielectric(p, materials, kInside, kOutside);
  materials.describe(p.node(), d.description);
  const auto side = [&](double eta) {
    return materials.add(isa_host::Dielectric::Stored{.specular_reflectance = d.specular_reflectance,
                                                      .specular_transmittance = d.specular_transmittance,
                                                      .eta = static_cast<float>(eta)});
  };
  return {.front = side(d.eta), .back = side(1 / d.eta)};
}

}  // namespace norrsken
