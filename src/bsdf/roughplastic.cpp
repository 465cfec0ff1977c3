// roughplastic: host side.
//
// Side: the front scatters, the back is black; `twosided` makes both scatter.
#include "bsdf/roughplastic.h"

#include <fmt/core.h>

#include <algorithm>

#include "bsdf/coat_host.h"
#include "bsdf/microfacet_host.h"
#include "bsdf/rough_coat_host.h"

namespace norrsken {
namespace {

constexpr IorParameter kInside{
    .name = "int_ior",
    .fallback = "polypropylene",
    .text =
        "index of refraction inside, or a material's name (default \"polypropylene\"); it must differ from ext_ior"};
constexpr IorParameter kOutside{.name = "ext_ior", .fallback = "air", .text = "the same outside (default \"air\")"};

/// A number where the other rough models have a texture.
constexpr NumberParameter one_value(std::string_view name, std::string_view text, std::string_view in_place_of = {}) {
  return {.name = name,
          .fallback = kAlpha.fallback,
          .range = kAlpha.range,
          .text = text,
          .in_place_of = in_place_of,
          .takes_colors = true};
}
constexpr NumberParameter kOneAlpha = one_value("alpha", kAlpha.text);
constexpr NumberParameter kOneAlphaU =
    one_value("alpha_u", "the same along u; both or none, and both the same", "alpha");
constexpr NumberParameter kOneAlphaV =
    one_value("alpha_v", "the same along v; both or none, and both the same", "alpha");

/// Of a coat whose facets are alike along u and v.
double read_alpha(Parameters& p) {
  const int errors = p.diagnostics().error_count();
  const double alpha = p.read(kOneAlpha);
  const double alpha_u = p.read(kOneAlphaU.or_else(alpha)), alpha_v = p.read(kOneAlphaV.or_else(alpha));
  const bool has_u = p.has(kOneAlphaU.name), has_v = p.has(kOneAlphaV.name);
  if (!has_u && !has_v) return alpha;
  const std::string_view given = has_u ? kOneAlphaU.name : kOneAlphaV.name;
  if (p.diagnostics().error_count() == errors && (has_u != has_v || alpha_u != alpha_v || p.has(kOneAlpha.name))) {
    p.error(given, "bsdf 'roughplastic' has one roughness", "alpha, or alpha_u and alpha_v that are the same");
  }
  return alpha_u;
}

}  // namespace

Material compile_bsdf_roughplastic(Parameters& p, Materials& materials) {
  const CoatMaterial coat = read_coat(p, materials, kInside, kOutside);
  const bool ggx = p.read(kIsGgx);
  const double alpha = std::max<double>(isa_host::kMinAlpha, read_alpha(p));
  p.read(kSampleVisible);
  materials.describe(p.node(), fmt::format("{}, {}, alpha {:.3g}", coat.description, ggx ? "ggx" : "beckmann", alpha));
  if (coat.eta == 1) {
    refuse_same_ior(p, kInside, kOutside);
    return {};
  }
  const RoughCoat rough = rough_coat(alpha, ggx, coat.eta, isa_host::kTransmittances);
  isa_host::RoughPlastic::Stored stored{.coat = coat_slots(coat, rough.from_inside),
                                        .alpha = static_cast<float>(alpha),
                                        .ggx = ggx ? 1.0f : 0.0f,
                                        .transmittances = {}};
  std::ranges::transform(rough.transmittances, stored.transmittances, [](double t) { return static_cast<float>(t); });
  return {.front = materials.add(stored)};
}

}  // namespace norrsken
