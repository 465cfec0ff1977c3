// principled: host side.
//
// Side: the front; the back too, with the inverse index, where spec_trans lets light through.
#include "bsdf/principled.h"

#include <fmt/core.h>

#include <cmath>

#include "bsdf/disney_host.h"
#include "compile/materials.h"

namespace norrsken {
namespace {

using namespace disney;
using Stored = isa_host::Principled::Stored;

constexpr NumberParameter kMetallic = share("metallic", 0, "from dielectric to metal");
constexpr NumberParameter kSpecTrans = share("spec_trans", 0, "from diffuse to glass");
constexpr NumberParameter kSpecTint = share("spec_tint", 0, "share of base_color in the dielectric's reflection");
constexpr NumberParameter kClearcoat = share("clearcoat", 0, "a second specular lobe");
constexpr NumberParameter kClearcoatGloss = share("clearcoat_gloss", 0, "how sharp the second specular lobe is");
constexpr NumberParameter kEta{.name = "eta",
                               .fallback = 1.5,
                               .range = above(0, kMaxIndex),
                               .text = "index of refraction inside over that outside",
                               .in_place_of = "specular"};
constexpr NumberParameter kSpecular{.name = "specular",
                                    .fallback = 0.5,
                                    .range = kShare,
                                    .text = "1/0.08 of what is reflected head on",
                                    .beyond = Beyond::is_clamped,
                                    .takes_colors = true};
constexpr NumberParameter kDiffuseRate =
    rate("diffuse_reflectance_sampling_rate", "how often the diffuse lobe is sampled, in proportion");
constexpr NumberParameter kSpecularRate =
    rate("main_specular_sampling_rate", "how often the main specular lobe is sampled, in proportion");
constexpr NumberParameter kClearcoatRate =
    rate("clearcoat_sampling_rate", "how often the clear coat is sampled, in proportion");

double read_eta(Parameters& p, bool transmits) {
  const double eta = p.read(kEta);
  double specular = p.read(kSpecular);
  if (p.has(kEta.name)) {
    if (p.has(kSpecular.name)) p.error(kSpecular.name, "'specular' is given next to 'eta'", "eta or specular");
    // What is not there cannot be refracted at.
    return transmits && eta == 1 ? 1.001 : eta;
  }
  if (transmits && specular == 0) specular = 1e-3;
  return 2 / (1 - std::sqrt(0.08 * specular)) - 1;
}

}  // namespace

Material compile_bsdf_principled(Parameters& p, Materials& materials) {
  const ColorOrTexture base_color = materials.read(p, kBaseColor);
  const NumberOrTexture roughness = materials.read(p, kRoughness), anisotropic = materials.read(p, kAnisotropic);
  if (!anisotropic.is_zero()) materials.need_uv();
  const NumberOrTexture metallic = materials.read(p, kMetallic), spec_trans = materials.read(p, kSpecTrans);
  const bool transmits = !spec_trans.is_zero();
  const double eta = read_eta(p, transmits);
  const Stored front{.base_color = base_color,
                     .roughness = roughness,
                     .anisotropic = anisotropic,
                     .metallic = metallic,
                     .spec_trans = spec_trans,
                     .spec_tint = materials.read(p, kSpecTint),
                     .sheen = materials.read(p, kSheen),
                     .sheen_tint = materials.read(p, kSheenTint),
                     .flatness = materials.read(p, kFlatness),
                     .clearcoat = materials.read(p, kClearcoat),
                     .clearcoat_gloss = materials.read(p, kClearcoatGloss),
                     .eta = static_cast<float>(eta),
                     .is_back = 0,
                     .diffuse_rate = static_cast<float>(p.read(kDiffuseRate)),
                     .specular_rate = static_cast<float>(p.read(kSpecularRate)),
                     .clearcoat_rate = static_cast<float>(p.read(kClearcoatRate))};
  const glm::dvec3 base = base_color.rgb();
  materials.describe(p.node(), fmt::format("base color {:.3g} {:.3g} {:.3g}, roughness {:.3g}, eta {:.4g}{}", base.r,
                                           base.g, base.b, roughness.value, eta, transmits ? ", transmits" : ""));
  Material material{.front = materials.add(front)};
  if (transmits) {
    Stored back = front;
    back.eta = static_cast<float>(1 / eta), back.is_back = 1;
    material.back = materials.add(back);
  }
  return material;
}

}  // namespace norrsken
