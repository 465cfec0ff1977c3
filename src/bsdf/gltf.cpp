// gltf: host side.
//
// Side: the front; the back too where light is transmitted, alike if `thin`, otherwise with the inverse index.
#include "bsdf/gltf.h"

#include <fmt/core.h>

#include "compile/materials.h"

namespace norrsken {
namespace {

using Stored = isa_host::Gltf::Stored;

constexpr NumberParameter share(std::string_view name, double fallback, std::string_view text) {
  return {.name = name, .fallback = fallback, .range = kShare, .text = text, .beyond = Beyond::is_clamped};
}

constexpr ColorParameter kBaseColor{.name = "base_color",
                                    .fallback = 1,
                                    .range = kShare,
                                    .text = "what metal reflects head on, and the dielectric's base"};
constexpr ColorParameter kVertexColor{
    .name = "vertex_color", .fallback = 1, .range = kShare, .text = "factor on base_color"};
constexpr NumberParameter kMetallic = share("metallic", 1, "from dielectric to metal");
constexpr NumberParameter kRoughness = share("roughness", 1, "root of the facets' slope");
constexpr NumberParameter kIor{.name = "ior",
                               .fallback = 1.5,
                               .range = {0, 100},
                               .text = "index of refraction inside over that outside; 0: the dielectric reflects all"};
constexpr NumberParameter kSpecular = share("specular", 1, "factor on what the dielectric reflects");
constexpr ColorParameter kSpecularColor{.name = "specular_color",
                                        .fallback = 1,
                                        .range = {0, 1e4},
                                        .text = "factor on what the dielectric reflects head on, which stays below 1"};
constexpr NumberParameter kTransmission = share("transmission", 0, "from a diffuse base to one that light passes");
constexpr BooleanParameter kThin{
    .name = "thin", .fallback = true, .text = "light passes without being bent, as through a sheet of no thickness"};
constexpr NumberParameter kClearcoat = share("clearcoat", 0, "share of a coat of index 1.5 over everything");
constexpr NumberParameter kClearcoatRoughness =
    share("clearcoat_roughness", 0, "root of the slope of the coat's facets");
constexpr ColorParameter kSheenColor{
    .name = "sheen_color", .fallback = 0, .range = kShare, .text = "of the back-scattering of fibres below the coat"};
constexpr NumberParameter kSheenRoughness = share("sheen_roughness", 0, "root of how far its fibres lean");

}  // namespace

Material compile_bsdf_gltf(Parameters& p, Materials& materials) {
  const ColorOrTexture base_color = materials.read(p, kBaseColor);
  const NumberOrTexture roughness = materials.read(p, kRoughness), metallic = materials.read(p, kMetallic);
  const NumberOrTexture transmission = materials.read(p, kTransmission);
  const double ior = p.read(kIor);
  const bool transmits = !transmission.is_zero(), thin = p.read(kThin) || !transmits;
  const double reflected = ior == 0 ? 1 : (ior - 1) / (ior + 1) * ((ior - 1) / (ior + 1));
  // What is not there cannot be refracted at.
  const double eta = ior == 0 ? 1.5 : ior == 1 ? 1.001 : ior;
  const Stored front{.base_color = base_color,
                     .vertex_color = materials.read(p, kVertexColor),
                     .specular_color = materials.read(p, kSpecularColor),
                     .sheen_color = materials.read(p, kSheenColor),
                     .metallic = metallic,
                     .roughness = roughness,
                     .specular = materials.read(p, kSpecular),
                     .transmission = transmission,
                     .clearcoat = materials.read(p, kClearcoat),
                     .clearcoat_roughness = materials.read(p, kClearcoatRoughness),
                     .sheen_roughness = materials.read(p, kSheenRoughness),
                     .f0 = static_cast<float>(reflected),
                     .eta = static_cast<float>(eta),
                     .is_thin = thin ? 1.0f : 0.0f,
                     .is_back = 0};
  const glm::dvec3 base = base_color.rgb();
  materials.describe(p.node(),
                     fmt::format("base color {:.3g} {:.3g} {:.3g}, metallic {:.3g}, roughness {:.3g}{}", base.r, base.g,
                                 base.b, metallic.value, roughness.value, transmits ? ", transmits" : ""));
  Material material{.front = materials.add(front)};
  if (!transmits) return material;
  Stored back = front;
  if (!thin) back.eta = static_cast<float>(1 / eta), back.is_back = 1;
  material.back = materials.add(back);
  return material;
}

}  // namespace norrsken
