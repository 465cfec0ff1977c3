// plastic: host side.
//
// Side: the front scatters, the back is black; `twosided` makes both scatter.
#include "bsdf/plastic.h"

#include "bsdf/coat_host.h"
#include "bsdf/fresnel_host.h"

namespace norrsken {
namespace {

constexpr IorParameter kInside{.name = "int_ior",
                               .fallback = "polypropylene",
                               .text = "index of refraction inside, or a material's name (default \"polypropylene\")"};
constexpr IorParameter kOutside{.name = "ext_ior", .fallback = "air", .text = "the same outside (default \"air\")"};

}  // namespace

Material compile_bsdf_plastic(Parameters& p, Materials& materials) {
  const CoatMaterial coat = read_coat(p, materials, kInside, kOutside);
  materials.describe(p.node(), coat.description);
  const double from_inside = fresnel_diffuse_reflectance(1 / coat.eta);
  return {.front = materials.add(isa_host::Plastic::Stored{.coat = coat_slots(coat, from_inside)})};
}

}  // namespace norrsken
