// principledthin: host side.
//
// Side: both, alike.
#include "bsdf/principledthin.h"

#include <fmt/core.h>

#include "bsdf/disney_host.h"
#include "compile/materials.h"

namespace norrsken {
namespace {

using namespace disney;

constexpr NumberParameter kSpecTrans = share("spec_trans", 0, "from diffuse to specular");
constexpr NumberParameter kSpecTint = share("spec_tint", 0, "share of base_color in the specular reflection");
constexpr NumberParameter kEta{
    .name = "eta", .fallback = 1.5, .range = above(0, kMaxIndex), .text = "index of refraction of the sheet"};
constexpr NumberParameter kDiffTrans{.name = "diff_trans",
                                     .fallback = 0,
                                     .range = {0, 2},
                                     .text = "diffuse light that passes the sheet, 2 is all of it"};
constexpr NumberParameter kSpecularReflectionRate =
    rate("specular_reflectance_sampling_rate", "how often specular reflection is sampled, in proportion");
constexpr NumberParameter kSpecularTransmissionRate =
    rate("specular_transmittance_sampling_rate", "how often specular transmission is sampled, in proportion");
constexpr NumberParameter kReflectionRate =
    rate("diffuse_reflectance_sampling_rate", "how often diffuse reflection is sampled, in proportion");
constexpr NumberParameter kTransmissionRate =
    rate("diffuse_transmittance_sampling_rate", "how often diffuse transmission is sampled, in proportion");

}  // namespace

Material compile_bsdf_principledthin(Parameters& p, Materials& materials) {
  const ColorOrTexture base_color = materials.read(p, kBaseColor);
  const NumberOrTexture roughness = materials.read(p, kRoughness), anisotropic = materials.read(p, kAnisotropic);
  if (!anisotropic.is_zero()) materials.need_uv();
  const isa_host::PrincipledThin::Stored stored{
      .base_color = base_color,
      .roughness = roughness,
      .anisotropic = anisotropic,
      .spec_trans = materials.read(p, kSpecTrans),
      .spec_tint = materials.read(p, kSpecTint),
      .sheen = materials.read(p, kSheen),
      .sheen_tint = materials.read(p, kSheenTint),
      .flatness = materials.read(p, kFlatness),
      .eta = materials.read(p, kEta),
      .diff_trans = materials.read(p, kDiffTrans),
      .specular_reflection_rate = static_cast<float>(p.read(kSpecularReflectionRate)),
      .specular_transmission_rate = static_cast<float>(p.read(kSpecularTransmissionRate)),
      .reflection_rate = static_cast<float>(p.read(kReflectionRate)),
      .transmission_rate = static_cast<float>(p.read(kTransmissionRate))};
  const glm::dvec3 base = base_color.rgb();
  materials.describe(p.node(), fmt::format("base color {:.3g} {:.3g} {:.3g}, roughness {:.3g}", base.r, base.g, base.b,
                                           roughness.value));
  const MaterialWord word = materials.add(stored);
  return {.front = word, .back = word};
}

}  // namespace norrsken
