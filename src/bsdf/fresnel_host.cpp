#include "bsdf/fresnel_host.h"

namespace norrsken {

double fresnel_diffuse_reflectance(double eta) {
  const double x = 1 / eta;
  if (eta < 1) return 0.0636 * x + 0.6681 + eta * (0.7099 - 1.4399 * eta);
  return 0.919317 + x * (-3.4793 + x * (6.75335 + x * (-7.80989 + x * (4.98554 - 1.36881 * x))));
}

}  // namespace norrsken
