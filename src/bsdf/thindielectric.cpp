// thindielectric: host side.
//
// Side: both alike.
#include "bsdf/thindielectric.h"

#include "bsdf/dielectric_host.h"

namespace norrsken {
namespace {

constexpr IorParameter kInside{.name = "int_ior",
                               .fallback = "bk7",
                               .text = "index of refraction of the sheet, or a material's name (default \"bk7\")"};
constexpr IorParameter kOutside{
    .name = "ext_ior", .fallback = "air", .text = "of what is on both sides of it (default \"air\")"};

}  // namespace

Material compile_bsdf_thindielectric(Parameters& p, Materials& materials) {
  const DielectricMaterial d = read_dielectric(p, materials, kInside, kOutside);
  materials.describe(p.node(), d.description);
  const MaterialWord word =
      materials.add(isa_host::ThinDielectric::Stored{.specular_reflectance = d.specular_reflectance,
                                                     .specular_transmittance = d.specular_transmittance,
                                                     .eta = static_cast<float>(d.eta)});
  return {.front = word, .back = word};
}

}  // namespace norrsken
