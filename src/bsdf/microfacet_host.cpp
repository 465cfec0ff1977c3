#include "bsdf/microfacet_host.h"

#include <fmt/core.h>

namespace norrsken {

Roughness read_roughness(Parameters& p, Materials& materials) {
  Roughness r;
  r.ggx = p.read(kIsGgx);
  p.read(kSampleVisible);
  const NumberOrTexture alpha = materials.read(p, kAlpha);
  r.alpha_u = materials.read(p, kAlphaU), r.alpha_v = materials.read(p, kAlphaV);
  const bool has_u = p.has(kAlphaU.name), has_v = p.has(kAlphaV.name);
  if (!has_u && !has_v) {
    r.alpha_u = r.alpha_v = alpha;
    return r;
  }
  constexpr char kAccepted[] = "alpha, or both of alpha_u and alpha_v";
  if (p.has(kAlpha.name)) p.error(kAlpha.name, "'alpha' is given next to 'alpha_u' or 'alpha_v'", kAccepted);
  if (has_u != has_v) {
    const std::string_view given = has_u ? kAlphaU.name : kAlphaV.name, missing = has_u ? kAlphaV.name : kAlphaU.name;
    p.error(given, fmt::format("'{}' is given without '{}'", given, missing), kAccepted);
  }
  materials.need_uv();  // the directions of u and v are those of the texture coordinates
  return r;
}

isa_host::RoughnessSlots roughness_slots(const Roughness& r) {
  return {.alpha_u = r.alpha_u, .alpha_v = r.alpha_v, .ggx = r.ggx ? 1.0f : 0.0f};
}

std::string describe_roughness(const Roughness& r) {
  const auto text = [](const NumberOrTexture& alpha) {
    return alpha.texture == 0 ? fmt::format("{:.3g}", alpha.value) : std::string("textured");
  };
  const std::string u = text(r.alpha_u), v = text(r.alpha_v);
  return fmt::format("{}, alpha {}", r.ggx ? "ggx" : "beckmann", u == v ? u : u + " and " + v);
}

}  // namespace norrsken
