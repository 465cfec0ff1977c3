#include "bsdf/microfacet_host.h"

#include <fmt/format.h>

#include "base/text.h"

namespace norrsken {
namespace {

constexpr double kDefaultAlpha = 0.1;

}  // namespace

bool read_is_ggx(Parameters& p) {
  const std::string name = p.text("distribution", "beckmann");
  for (const bool ggx : {false, true}) {
    if (equal_ignoring_case(name, ggx ? "ggx" : "beckmann")) return ggx;
  }
  p.error("distribution", fmt::format("'distribution' is {}{}", quoted(name), did_you_mean(name, {"beckmann", "ggx"})),
          "beckmann, ggx");
  return false;
}

Roughness read_roughness(Parameters& p, Builder& builder) {
  Roughness r;
  r.ggx = read_is_ggx(p);
  p.boolean("sample_visible", true);
  const auto slope = [&](std::string_view name) { return builder.scalar(p, name, kDefaultAlpha, 0, kMaxAlpha); };
  const ScalarParameter alpha = slope("alpha");
  r.alpha_u = slope("alpha_u"), r.alpha_v = slope("alpha_v");
  const bool has_u = p.has("alpha_u"), has_v = p.has("alpha_v");
  if (!has_u && !has_v) {
    r.alpha_u = r.alpha_v = alpha;
    return r;
  }
  constexpr char kAccepted[] = "alpha, or both of alpha_u and alpha_v";
  if (p.has("alpha")) p.error("alpha", "'alpha' is given next to 'alpha_u' or 'alpha_v'", kAccepted);
  if (has_u != has_v) {
    const std::string_view given = has_u ? "alpha_u" : "alpha_v", missing = has_u ? "alpha_v" : "alpha_u";
    p.error(given, fmt::format("'{}' is given without '{}'", given, missing), kAccepted);
  }
  builder.need_uv();  // the directions of u and v are those of the texture coordinates
  return r;
}

void add_roughness(ParameterBlock& block, const Roughness& r) {
  block.add(r.alpha_u).add(r.alpha_v).add(r.ggx ? 1.0 : 0.0);
}

std::string describe_roughness(const Roughness& r) {
  const auto text = [](const ScalarParameter& alpha) {
    return alpha.texture == 0 ? fmt::format("{:.3g}", alpha.value) : std::string("textured");
  };
  const std::string u = text(r.alpha_u), v = text(r.alpha_v);
  return fmt::format("{}, alpha {}", r.ggx ? "ggx" : "beckmann", u == v ? u : u + " and " + v);
}

}  // namespace norrsken
