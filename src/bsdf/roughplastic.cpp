// roughplastic: host side.
//
// Parameters
//   diffuse_reflectance, specular_reflectance, int_ior, ext_ior, nonlinear   as in `plastic`; the indices must differ
//   distribution    "beckmann" (default) or "ggx"
//   alpha           float, 0 to 100 (default 0.1): roughness, the root mean square slope of the facets
//   sample_visible  boolean: accepted; visible normals are sampled either way
// Stored: what coat.h lists, alpha, 1 for ggx, the coat's transmittances for cosines evenly from 0 to 1.
// Side: the front scatters, the back is black; `twosided` makes both scatter.
#include "bsdf/roughplastic.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bsdf/coat_host.h"
#include "bsdf/microfacet_host.h"
#include "compile/plugins.h"

namespace norrsken {
namespace {

using namespace isa_host;

struct Node {
  double x, weight;
};

/// Gauss' rule on [0, 1]: zeros of the Legendre polynomial, by Newton's method.
template <std::size_t n>
std::array<Node, n> gauss_rule() {
  std::array<Node, n> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (double(i) + 0.75) / (double(n) + 0.5)), slope = 0;
    for (int step = 0; step < 10; ++step) {
      double before = 1, value = x;
      for (std::size_t k = 2; k <= n; ++k) {
        const double next = (double(2 * k - 1) * x * value - double(k - 1) * before) / double(k);
        before = value, value = next;
      }
      slope = double(n) * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes[i] = {(x + 1) / 2, 1 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

struct Shares {
  double reflected, transmitted;
};

/// What a rough interface does with light from wo, over visible normals. Facets that others mask absorb.
template <std::size_t n>
Shares shares_of(const Microfacet& facets, double cos_theta, double eta) {
  static const std::array<Node, n> nodes = gauss_rule<n>();
  const Vec3f wo{Float(float(std::sqrt(1 - cos_theta * cos_theta))), Float(0.0f), Float(float(cos_theta))};
  Shares sum{};
  for (const Node& u : nodes) {
    for (const Node& v : nodes) {
      const Vec3f m = facets.sample_visible(wo, {Float(float(u.x)), Float(float(v.x))});
      const Float cos_i = dot(wo, m);
      const FresnelDielectric f = fresnel_dielectric(cos_i, Float(float(eta)));
      const Vec3f mirrored = reflect(wo, m, cos_i), refracted = refract(wo, m, cos_i, f.cos_t, Float(float(eta)));
      const double weight = u.weight * v.weight, reflectance = double(f.reflectance.v);
      if (mirrored.z.v > 0) sum.reflected += weight * reflectance * double(facets.masking(mirrored, m).v);
      if (refracted.z.v < 0) sum.transmitted += weight * (1 - reflectance) * double(facets.masking(refracted, m).v);
    }
  }
  return sum;
}

/// Cosine of the table's entry i.
double cosine(std::uint32_t i) { return std::max(1e-6, double(i) / (kTransmittances - 1)); }

}  // namespace

Material compile_bsdf_roughplastic(Parameters& p, Builder& builder) {
  const CoatMaterial coat = read_coat(p, builder);
  const bool ggx = read_is_ggx(p);
  const double alpha = std::max<double>(kMinAlpha, p.number("alpha", 0.1, 0, kMaxAlpha));
  p.boolean("sample_visible", true);
  builder.describe(p.node(), fmt::format("{}, {}, alpha {:.3g}", coat.description, ggx ? "ggx" : "beckmann", alpha));
  if (coat.eta == 1) {
    p.error(p.has("int_ior") ? "int_ior" : "ext_ior", "the indices of refraction of both sides are the same",
            "int_ior and ext_ior that differ");
    return {};
  }
  const Microfacet facets{Float(float(alpha)), Float(float(alpha)), Mask{ggx}};
  // A plain mean over the table's cosines, ends included, as Mitsuba takes it: some percent off the integral.
  double from_inside = 0;
  for (std::uint32_t i = 0; i < kTransmittances; ++i) {
    from_inside += 2 * cosine(i) * shares_of<64>(facets, cosine(i), 1 / coat.eta).reflected / kTransmittances;
  }
  ParameterBlock block = coat_block(coat, from_inside).add(alpha).add(ggx ? 1.0 : 0.0);
  for (std::uint32_t i = 0; i < kTransmittances; ++i) {
    block.add(shares_of<32>(facets, cosine(i), coat.eta).transmitted);
  }
  return {.front = builder.add_material(BsdfKind::roughplastic, block)};
}

}  // namespace norrsken
