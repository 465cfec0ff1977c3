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
  const bool has_u = p.has("alpha_u"), has_v = p.has("alpha_v");
  if (!has_u && !has_v) {
    r.alpha_u = r.alpha_v = builder.scalar(p, "alpha", kDefaultAlpha, 0, kMaxAlpha);
    return r;
  }
  if (p.has("alpha")) {
    p.error("alpha", "'alpha' is given next to 'alpha_u' or 'alpha_v'", "alpha, or both of alpha_u and alpha_v");
    builder.scalar(p, "alpha", kDefaultAlpha, 0, kMaxAlpha);
  }
  if (has_u != has_v) {
    p.error(has_u ? "alpha_u" : "alpha_v",
            fmt::format("'{}' is given without '{}'", has_u ? "alpha_u" : "alpha_v", has_u ? "alpha_v" : "alpha_u"),
            "alpha, or both of alpha_u and alpha_v");
  }
  r.alpha_u = builder.scalar(p, "alpha_u", kDefaultAlpha, 0, kMaxAlpha);
  r.alpha_v = builder.scalar(p, "alpha_v", kDefaultAlpha, 0, kMaxAlpha);
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
