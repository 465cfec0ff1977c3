// principledthin: host side.
//
// Parameters
//   base_color       color or texture, 0 to 1 (default 0.5)
//   roughness        float or texture, 0 to 1 (default 0.5): root of the facets' slope
//   anisotropic      float or texture, 0 to 1 (default 0): roughness less along u of the texture coordinates than along v
//   spec_trans       float or texture, 0 to 1 (default 0): from diffuse to specular
//   eta              float or texture greater than 0 (default 1.5): index of refraction of the sheet
//   spec_tint        float or texture, 0 to 1 (default 0): share of base_color in the specular reflection
//   sheen, sheen_tint  float or texture, 0 to 1 (default 0): a lobe at grazing angles, and how far it has base_color's tint
//   flatness         float or texture, 0 to 1 (default 0): from diffuse to an approximation of subsurface scattering
//   diff_trans       float or texture, 0 to 2 (default 0): diffuse light that passes the sheet, 2 is all of it
//   specular_reflectance_sampling_rate, specular_transmittance_sampling_rate, diffuse_reflectance_sampling_rate,
//   diffuse_transmittance_sampling_rate
//                    float from 0 (default 1): how often each lobe is sampled, in proportion
// What is out of these ranges is clamped, with a warning.
// Stored: base_color (colour); roughness, anisotropic, spec_trans, spec_tint, sheen, sheen_tint, flatness, eta, diff_trans
// (scalars); the four rates in the order above.
// Side: both, alike.
#include <fmt/format.h>

#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_principledthin(Parameters& p, Builder& builder) {
  constexpr double kMaxRate = 1e6, kMaxIndex = 1e4;
  const ColorParameter base_color = builder.color(p, "base_color", glm::dvec3(0.5), 0, 1);
  const ScalarParameter roughness = builder.share(p, "roughness", 0.5);
  const ScalarParameter anisotropic = builder.share(p, "anisotropic", 0);
  if (anisotropic.value != 0 || anisotropic.texture != 0) builder.need_uv();
  ParameterBlock block;
  block.add(base_color).add(roughness).add(anisotropic);
  for (const char* name : {"spec_trans", "spec_tint", "sheen", "sheen_tint", "flatness"}) {
    block.add(builder.share(p, name, 0));
  }
  block.add(builder.scalar(p, "eta", 1.5, 0, kMaxIndex, Ends::open_below))
      .add(builder.scalar(p, "diff_trans", 0, 0, 2));
  for (const char* name : {"specular_reflectance_sampling_rate", "specular_transmittance_sampling_rate",
                           "diffuse_reflectance_sampling_rate", "diffuse_transmittance_sampling_rate"}) {
    block.add(p.number(name, 1, 0, kMaxRate));
  }
  builder.describe(p.node(), fmt::format("base color {:.3g} {:.3g} {:.3g}, roughness {:.3g}", base_color.value.r,
                                         base_color.value.g, base_color.value.b, roughness.value));
  const MaterialWord word = builder.add_material(BsdfKind::principledthin, block);
  return {.front = word, .back = word};
}

}  // namespace norrsken
