// principled: host side.
//
// Parameters
//   base_color       color or texture, 0 to 1 (default 0.5)
//   roughness        float or texture, 0 to 1 (default 0.5): root of the facets' slope
//   anisotropic      float or texture, 0 to 1 (default 0): roughness less along u of the texture coordinates than along v
//   metallic         float or texture, 0 to 1 (default 0): from dielectric to metal
//   spec_trans       float or texture, 0 to 1 (default 0): from diffuse to glass
//   eta              float greater than 0: index of refraction inside over that outside; or else
//   specular         float, 0 to 1 (default 0.5): 1/0.08 of what is reflected head on
//   spec_tint        float or texture, 0 to 1 (default 0): share of base_color in the dielectric's reflection
//   sheen, sheen_tint  float or texture, 0 to 1 (default 0): a lobe at grazing angles, and how far it has base_color's tint
//   flatness         float or texture, 0 to 1 (default 0): from diffuse to an approximation of subsurface scattering
//   clearcoat, clearcoat_gloss  float or texture, 0 to 1 (default 0): a second specular lobe, and how sharp it is
//   diffuse_reflectance_sampling_rate, main_specular_sampling_rate, clearcoat_sampling_rate
//                    float from 0 (default 1): how often each lobe is sampled, in proportion
// What is out of these ranges is clamped, with a warning.
// Stored: base_color (colour); roughness, anisotropic, metallic, spec_trans, spec_tint, sheen, sheen_tint, flatness,
// clearcoat, clearcoat_gloss (scalars); relative index of refraction, 1 for the back, the three rates.
// Side: the front; the back too, with the inverse index, where spec_trans lets light through.
#include <fmt/format.h>

#include <cmath>

#include "compile/plugins.h"

namespace norrsken {
namespace {

constexpr double kMaxRate = 1e6, kMaxIndex = 1e4;

double read_eta(Parameters& p, bool transmits) {
  const double eta = p.number("eta", 1.5, 0, kMaxIndex, Ends::open_below);
  double specular = p.mean_clamped("specular", 0.5, 0, 1);
  if (p.has("eta")) {
    if (p.has("specular")) p.error("specular", "'specular' is given next to 'eta'", "eta or specular");
    // What is not there cannot be refracted at.
    return transmits && eta == 1 ? 1.001 : eta;
  }
  if (transmits && specular == 0) specular = 1e-3;
  return 2 / (1 - std::sqrt(0.08 * specular)) - 1;
}

}  // namespace

Material compile_bsdf_principled(Parameters& p, Builder& builder) {
  const ColorParameter base_color = builder.color(p, "base_color", glm::dvec3(0.5), 0, 1);
  const ScalarParameter roughness = builder.share(p, "roughness", 0.5);
  ParameterBlock block;
  block.add(base_color).add(roughness);
  bool transmits = false;
  for (const std::string_view name : {"anisotropic", "metallic", "spec_trans", "spec_tint", "sheen", "sheen_tint",
                                      "flatness", "clearcoat", "clearcoat_gloss"}) {
    const ScalarParameter value = builder.share(p, name, 0);
    const bool matters = value.value != 0 || value.texture != 0;
    if (matters && name == "anisotropic") builder.need_uv();
    if (matters && name == "spec_trans") transmits = true;
    block.add(value);
  }
  const double eta = read_eta(p, transmits);
  double rates[3];
  const char* const rate_names[] = {"diffuse_reflectance_sampling_rate", "main_specular_sampling_rate",
                                    "clearcoat_sampling_rate"};
  for (int i = 0; i < 3; ++i) rates[i] = p.number(rate_names[i], 1, 0, kMaxRate);
  builder.describe(p.node(), fmt::format("base color {:.3g} {:.3g} {:.3g}, roughness {:.3g}, eta {:.4g}{}",
                                         base_color.value.r, base_color.value.g, base_color.value.b, roughness.value,
                                         eta, transmits ? ", transmits" : ""));
  const auto side = [&](double relative, double is_back) {
    ParameterBlock all = block;
    return builder.add_material(BsdfKind::principled,
                                all.add(relative).add(is_back).add(rates[0]).add(rates[1]).add(rates[2]));
  };
  Material material{.front = side(eta, 0)};
  if (transmits) material.back = side(1 / eta, 1);
  return material;
}

}  // namespace norrsken
