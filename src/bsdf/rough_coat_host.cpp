#include "bsdf/rough_coat_host.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <tuple>
#include <utility>

#include "bsdf/fresnel.h"
#include "bsdf/microfacet.h"

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

constexpr std::size_t kAlong = 32, kAcross = 16;
constexpr float kLastErf = 0.99999994f;  // the last float before 1

/// Slopes of Beckmann's facets along the direction of view, of which those across it are independent.
struct BeckmannSlopes {
  std::array<float, kAlong> along;
  std::array<double, kAlong> weights;  ///< how much of them is seen
};

float slope_of(double erf_value, float alpha) {
  return alpha * erf_inv(Float(std::clamp(float(erf_value), -kLastErf, kLastErf))).v;
}

/// The slopes along that are seen: an even rule over the error function of the slope up to the steepest that is not
/// turned away, where slopes are seen as far as they face the viewer.
void look_along(double tan_theta, float alpha, const std::array<QuadratureNode, kAlong>& rule, BeckmannSlopes& slopes) {
  const double end = std::erf(1 / (double(alpha) * tan_theta));
  for (std::size_t i = 0; i < kAlong; ++i) {
    slopes.along[i] = -slope_of(rule[i].x * (1 + end) - 1, alpha);
    slopes.weights[i] = rule[i].weight * std::max(1 + double(slopes.along[i]) * tan_theta, 0.0);
  }
}

/// Shares of the light from a direction that facets around m let through to the other side, and send back inside.
struct Shares {
  Float transmitted, reflected_inside;
};

Shares shares_at(const Microfacet& facets, const Vec3f& wo, const Vec3f& m, Float ior, Float inverse_ior) {
  const Float cos_i = dot(wo, m), none(0.0f);
  const FresnelDielectric f = fresnel_dielectric(cos_i, ior);
  const Vec3f refracted = refract(wo, m, cos_i, f.cos_t, ior), mirrored = reflect(wo, m, cos_i);
  const Float through = (Float(1.0f) - f.reflectance) * facets.masking(refracted, m);
  const Float back = fresnel_dielectric(cos_i, inverse_ior).reflectance * facets.masking(mirrored, m);
  return {zero_unless(refracted.z < none, through), zero_unless(mirrored.z > none, back)};
}

/// The loop over normals across is one that compilers turn into vectors: nothing in it depends on the turn before.
template <bool ggx>
RoughCoat integrate(float alpha, double eta, std::uint32_t cosines) {
  static const auto all = gauss_rule<kAlong>();
  // Normals left and right of the plane of incidence do alike, so that half of them will do.
  static const auto half = gauss_rule<kAcross>();
  const Microfacet facets{Float(alpha), Float(alpha), Mask{ggx}};
  const Float ior = static_cast<float>(eta), inverse_ior = static_cast<float>(1 / eta);
  BeckmannSlopes slopes;
  // Across the direction of view: the slope of Beckmann, the azimuth of GGX.
  std::array<float, kAcross> across, azimuth_sines, azimuth_cosines, transmitted, reflected;
  for (std::size_t k = 0; k < kAcross; ++k) {
    across[k] = slope_of(half[k].x, alpha);
    azimuth_sines[k] = static_cast<float>(std::sin(std::numbers::pi * half[k].x));
    azimuth_cosines[k] = static_cast<float>(std::cos(std::numbers::pi * half[k].x));
  }
  RoughCoat coat{{}, 0};
  for (std::uint32_t i = 0; i < cosines; ++i) {
    const double cos_theta = std::max(1e-6, double(i) / (cosines - 1)),
                 sin_theta = std::sqrt(1 - cos_theta * cos_theta);
    const Vec3f wo{Float(float(sin_theta)), Float(0.0f), Float(float(cos_theta))};
    if (!ggx) look_along(sin_theta / cos_theta, alpha, all, slopes);
    double transmittance = 0, reflectance = 0, total = 0;
    for (std::size_t row = 0; row < kAlong; ++row) {
      const Float along(ggx ? float(all[row].x) : slopes.along[row]);
      for (std::size_t k = 0; k < kAcross; ++k) {
        const Vec3f m = ggx ? facets.sample_visible_ggx(wo, {Float(azimuth_sines[k]), Float(azimuth_cosines[k])}, along)
                            : normalize(Vec3f{along, Float(across[k]), Float(1.0f)});
        const Shares shares = shares_at(facets, wo, m, ior, inverse_ior);
        transmitted[k] = shares.transmitted.v, reflected[k] = shares.reflected_inside.v;
      }
      const double weight = ggx ? all[row].weight : slopes.weights[row];
      for (std::size_t k = 0; k < kAcross; ++k) {
        transmittance += weight * half[k].weight * double(transmitted[k]);
        reflectance += weight * half[k].weight * double(reflected[k]);
      }
      total += weight;
    }
    coat.transmittances.push_back(transmittance / total);
    // A plain mean over the table's cosines, ends included, as Mitsuba takes it: some percent off the integral.
    coat.from_inside += 2 * cos_theta * reflectance / total / cosines;
  }
  return coat;
}

}  // namespace

RoughCoat integrate_rough_coat(float alpha, bool ggx, double eta, std::uint32_t cosines) {
  return ggx ? integrate<true>(alpha, eta, cosines) : integrate<false>(alpha, eta, cosines);
}

RoughCoat rough_coat(double alpha, bool ggx, double eta, std::uint32_t cosines) {
  using Inputs = std::tuple<double, bool, double, std::uint32_t>;
  thread_local std::deque<std::pair<Inputs, RoughCoat>> latest;
  constexpr std::size_t kKept = 64;
  const Inputs inputs{alpha, ggx, eta, cosines};
  const auto known = std::ranges::find(latest, inputs, &std::pair<Inputs, RoughCoat>::first);
  if (known != latest.end()) return known->second;
  if (latest.size() == kKept) latest.pop_front();
  latest.emplace_back(inputs, integrate_rough_coat(float(alpha), ggx, eta, cosines));
  return latest.back().second;
}

}  // namespace norrsken
