// roughplastic: host side.
//
// Parameters
//   diffuse_reflectance, specular_reflectance, int_ior, ext_ior, nonlinear   as in `plastic`; the indices must differ
//   distribution    "beckmann" (default) or "ggx"
//   alpha           float, 0 to 100 (default 0.1): roughness, the root mean square slope of the facets
//   alpha_u, alpha_v  both, in place of alpha; they must be the same
//   sample_visible  boolean: accepted; visible normals are sampled either way
// Stored: what coat.h lists, alpha, 1 for ggx, the coat's transmittances for cosines evenly from 0 to 1.
// Side: the front scatters, the back is black; `twosided` makes both scatter.
#include "bsdf/roughplastic.h"

#include <fmt/format.h>

#include <algorithm>

#include "bsdf/coat_host.h"
#include "bsdf/microfacet_host.h"
#include "bsdf/rough_coat_host.h"
#include "compile/plugins.h"

namespace norrsken {
namespace {

/// Of a coat whose facets are alike along u and v.
double read_alpha(Parameters& p) {
  const int errors = p.diagnostics().error_count();
  const double alpha = p.mean("alpha", 0.1, 0, kMaxAlpha);
  const double alpha_u = p.mean("alpha_u", alpha, 0, kMaxAlpha), alpha_v = p.mean("alpha_v", alpha, 0, kMaxAlpha);
  const bool has_u = p.has("alpha_u"), has_v = p.has("alpha_v");
  if (!has_u && !has_v) return alpha;
  const std::string_view given = has_u ? "alpha_u" : "alpha_v";
  if (p.diagnostics().error_count() == errors && (has_u != has_v || alpha_u != alpha_v || p.has("alpha"))) {
    p.error(given, "bsdf 'roughplastic' has one roughness", "alpha, or alpha_u and alpha_v that are the same");
  }
  return alpha_u;
}

}  // namespace

Material compile_bsdf_roughplastic(Parameters& p, Builder& builder) {
  const CoatMaterial coat = read_coat(p, builder);
  const bool ggx = read_is_ggx(p);
  const double alpha = std::max<double>(isa_host::kMinAlpha, read_alpha(p));
  p.boolean("sample_visible", true);
  builder.describe(p.node(), fmt::format("{}, {}, alpha {:.3g}", coat.description, ggx ? "ggx" : "beckmann", alpha));
  if (coat.eta == 1) {
    p.error(p.has("int_ior") ? "int_ior" : "ext_ior", "the indices of refraction of both sides are the same",
            "int_ior and ext_ior that differ");
    return {};
  }
  const RoughCoat rough = rough_coat(alpha, ggx, coat.eta, isa_host::kTransmittances);
  ParameterBlock block = coat_block(coat, rough.from_inside).add(alpha).add(ggx ? 1.0 : 0.0);
  for (const double transmittance : rough.transmittances) block.add(transmittance);
  return {.front = builder.add_material(BsdfKind::roughplastic, block)};
}

}  // namespace norrsken
