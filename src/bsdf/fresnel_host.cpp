#include "bsdf/fresnel_host.h"

#include <cmath>

namespace norrsken {
namespace {

/// Of unpolarised light that enters the denser medium, eta >= 1.
double fresnel(double cos_i, double eta) {
  const double cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (eta * eta));
  const double r_s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const double r_p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return (r_s * r_s + r_p * r_p) / 2;
}

}  // namespace

double fresnel_diffuse_reflectance(double eta) {
  // The same flux crosses in both directions between media of radiance 1 and eta^2.
  if (eta < 1) return 1 - eta * eta * (1 - fresnel_diffuse_reflectance(1 / eta));
  if (eta == 1) return 0;
  // The integral of 2 c F(c) over cosines c, by the midpoint rule; c = t^3 spreads out the grazing angles, where F
  // rises to 1 the more steeply the closer eta is to 1.
  constexpr int kSteps = 4096;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps, c = t * t * t;
    sum += 2 * c * fresnel(c, eta) * 3 * t * t;
  }
  return sum / kSteps;
}

}  // namespace norrsken
