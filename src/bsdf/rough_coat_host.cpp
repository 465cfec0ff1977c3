#include "bsdf/rough_coat_host.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <tuple>
#include <utility>

#include "bsdf/fresnel.h"

namespace norrsken {
namespace {

using namespace isa_host;

struct QuadratureNode {
  double x, weight;
};

/// Gauss' rule on [0, 1]: zeros of the Legendre polynomial, by Newton's method.
template <std::size_t n>
std::array<QuadratureNode, n> gauss_rule() {
  std::array<QuadratureNode, n> nodes;
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

/// Share of light from `wo` that facets around `m` let through to the other side.
double transmitted_at(const Microfacet& facets, const Vec3f& wo, const Vec3f& m, double relative_ior) {
  const Float eta{float(relative_ior)}, cos_i = dot(wo, m);
  const FresnelDielectric f = fresnel_dielectric(cos_i, eta);
  const Vec3f refracted = refract(wo, m, cos_i, f.cos_t, eta);
  return refracted.z.v < 0 ? (1 - double(f.reflectance.v)) * double(facets.masking(refracted, m).v) : 0;
}

/// Share that they send back.
double reflected_at(const Microfacet& facets, const Vec3f& wo, const Vec3f& m, double relative_ior) {
  const Float cos_i = dot(wo, m);
  const Vec3f mirrored = reflect(wo, m, cos_i);
  if (!(mirrored.z.v > 0)) return 0;
  return double(fresnel_dielectric(cos_i, Float(float(relative_ior))).reflectance.v) *
         double(facets.masking(mirrored, m).v);
}

}  // namespace

RoughCoat integrate_rough_coat(const Microfacet& facets, double eta, std::uint32_t cosines) {
  static const auto all = gauss_rule<32>();
  // Normals left and right of the plane of incidence do alike, so that half of them will do.
  static const auto half = gauss_rule<16>();
  RoughCoat coat{{}, 0};
  for (std::uint32_t i = 0; i < cosines; ++i) {
    const double cos_theta = std::max(1e-6, double(i) / (cosines - 1));
    const Vec3f wo{Float(float(std::sqrt(1 - cos_theta * cos_theta))), Float(0.0f), Float(float(cos_theta))};
    double transmitted = 0, reflected_inside = 0;
    for (const QuadratureNode& along : all) {
      for (const QuadratureNode& across : half) {
        // Which coordinate turns normals out of the plane: the azimuth of GGX, the second slope of Beckmann.
        const Float u{float(along.x)}, v{float(across.x / 2)};
        const Vec3f m = facets.sample_visible(wo, facets.ggx.v ? Vec2f{v, u} : Vec2f{u, v});
        const double weight = along.weight * across.weight;
        transmitted += weight * transmitted_at(facets, wo, m, eta);
        reflected_inside += weight * reflected_at(facets, wo, m, 1 / eta);
      }
    }
    coat.transmittances.push_back(transmitted);
    // A plain mean over the table's cosines, ends included, as Mitsuba takes it: some percent off the integral.
    coat.from_inside += 2 * cos_theta * reflected_inside / cosines;
  }
  return coat;
}

RoughCoat rough_coat(double alpha, bool ggx, double eta, std::uint32_t cosines) {
  using Inputs = std::tuple<double, bool, double, std::uint32_t>;
  thread_local std::deque<std::pair<Inputs, RoughCoat>> latest;
  constexpr std::size_t kKept = 64;
  const Inputs inputs{alpha, ggx, eta, cosines};
  const auto known = std::ranges::find(latest, inputs, &std::pair<Inputs, RoughCoat>::first);
  if (known != latest.end()) return known->second;
  if (latest.size() == kKept) latest.pop_front();
  const Float a{float(alpha)};
  latest.emplace_back(inputs, integrate_rough_coat({a, a, Mask{ggx}}, eta, cosines));
  return latest.back().second;
}

}  // namespace norrsken
