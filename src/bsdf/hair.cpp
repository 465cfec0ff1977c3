// hair: strands of hair and fur, for shapes such as curves.
//
// The hair runs along the direction in which a texture coordinate grows: v, as on bsplinecurve and linearcurve.
//
// Side: both sides scatter.
#include "bsdf/hair.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "bsdf/ior_host.h"
#include "compile/materials.h"

namespace norrsken {
namespace {

/// Narrower lobes are lost to rounding.
constexpr double kSmoothest = 0.02;
constexpr double kMostAbsorption = 1e6;

constexpr NumberParameter kLongitudinal{.name = "longitudinal_roughness",
                                        .fallback = 0.3,
                                        .range = {kSmoothest, 1},
                                        .text = "along the hair",
                                        .beyond = Beyond::is_clamped_with_a_note};
constexpr NumberParameter kAzimuthal{.name = "azimuthal_roughness",
                                     .fallback = 0.3,
                                     .range = {kSmoothest, 1},
                                     .text = "around the hair",
                                     .beyond = Beyond::is_clamped_with_a_note};
constexpr NumberParameter kTilt{.name = "scale_tilt",
                                .fallback = 2,
                                .range = {-90, 90},
                                .text = "of the scales on the hair's surface",
                                .unit = "degrees"};
constexpr IorParameter kInside{"int_ior", "amber", "index of refraction of the hair: a number or a material"};
constexpr IorParameter kOutside{"ext_ior", "air", "index of refraction around it: a number or a material"};
constexpr NumberParameter kEumelanin{.name = "eumelanin",
                                     .fallback = 1.3,
                                     .range = {0, kMostAbsorption},
                                     .text = "concentration of the pigment of black and brown hair"};
constexpr NumberParameter kPheomelanin{.name = "pheomelanin",
                                       .fallback = 0.2,
                                       .range = {0, kMostAbsorption},
                                       .text = "concentration of the pigment of red hair"};
constexpr ColorParameter kAbsorption{.name = "sigma_a",
                                     .fallback = 0,
                                     .range = {0, kMostAbsorption},
                                     .text = "absorption along a radius of the hair; instead of the pigments"};
constexpr NumberParameter kScale{
    .name = "scale", .fallback = 1, .range = {0, kMostAbsorption}, .text = "factor on `sigma_a`"};

constexpr ChoiceParameter<std::uint32_t> kAlong{
    .name = "along",
    .words = {{{"v", 0}, {"u", 1}}},
    .text = "the texture coordinate that grows along the hair; not in Mitsuba, whose hairs run along v"};

/// Absorption of a unit of each pigment in RGB; d'Eon and others 2011, as Mitsuba has it.
constexpr glm::dvec3 kOfEumelanin{0.419, 0.697, 1.37}, kOfPheomelanin{0.187, 0.4, 1.05};

/// Chiang and others 2016, equation 7: the fit of the variance along the hair.
double variance_of(double roughness) {
  const double r = 0.726 * roughness + 0.812 * roughness * roughness + 3.7 * std::pow(roughness, 20);
  return r * r;
}
/// Equation 8: of the logistic distribution around it.
double scale_of(double roughness) {
  return std::sqrt(std::numbers::pi / 8) *
         (0.265 * roughness + 1.194 * roughness * roughness + 5.372 * std::pow(roughness, 22));
}

}  // namespace

Material compile_bsdf_hair(Parameters& p, Materials& materials) {
  const double longitudinal = p.read(kLongitudinal), azimuthal = p.read(kAzimuthal);
  const double tilt = glm::radians(p.read(kTilt));
  const double eta = read_relative_ior(p, kInside, kOutside);
  const double eumelanin = p.read(kEumelanin), pheomelanin = p.read(kPheomelanin);
  ColorOrTexture absorption = materials.read(p, kAbsorption);
  const double scale = p.read(kScale);
  const bool has_absorption = p.has(kAbsorption.name);
  for (const std::string_view pigment : {kEumelanin.name, kPheomelanin.name}) {
    if (!has_absorption || !p.has(pigment)) continue;
    p.error(pigment, fmt::format("'{}' is given next to 'sigma_a'", pigment), "pigments, or sigma_a");
  }
  if (!has_absorption) absorption = {SceneColor(eumelanin * kOfEumelanin + pheomelanin * kOfPheomelanin)};
  const std::uint32_t along_u = p.read(kAlong);
  materials.need_uv();
  const glm::dvec3 rgb = absorption.rgb() * (has_absorption ? scale : 1);
  materials.describe(p.node(), fmt::format("absorption {:.3g} {:.3g} {:.3g}", rgb.r, rgb.g, rgb.b));
  const MaterialWord word =
      materials.add(isa_host::Hair::Stored{.absorption = absorption,
                                           .absorption_scale = has_absorption ? static_cast<float>(scale) : 1.0f,
                                           .eta = static_cast<float>(eta),
                                           .variance = static_cast<float>(variance_of(longitudinal)),
                                           .azimuthal_scale = static_cast<float>(scale_of(azimuthal)),
                                           .sin_tilt = static_cast<float>(std::sin(tilt)),
                                           .cos_tilt = static_cast<float>(std::cos(tilt)),
                                           .along_u = along_u});
  return {.front = word, .back = word};
}

}  // namespace norrsken
