#include "film/interval.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace norrsken {
namespace {

/// Of the power mean of their variances: between the mean of variances, which the noisiest rule, and that of deviations.
constexpr float kExponent = 0.75f;

constexpr float kNormal = 1.959964f;  // 97.5 % of the normal distribution

/// Powers of the variances of one sample, added up over pixels, and how many pixels those were.
struct Pool {
  float power = 0, pixels = 0;
};

/// Each element becomes the sum of those up to `reach` away, of `count` elements that lie `stride` apart.
void sum_neighbors(std::span<Pool> pools, std::size_t first, std::size_t count, std::size_t stride, std::size_t reach,
                   std::vector<Pool>& line) {
  line.resize(count);
  for (std::size_t i = 0; i < count; ++i) line[i] = pools[first + i * stride];
  for (std::size_t i = 0; i < count; ++i) {
    Pool sum;
    const std::size_t begin = i < reach ? 0 : i - reach;
    for (std::size_t j = begin; j < std::min(i + reach + 1, count); ++j) {
      sum.power += line[j].power;
      sum.pixels += line[j].pixels;
    }
    pools[first + i * stride] = sum;
  }
}

}  // namespace

std::vector<float> confidence_intervals(std::uint32_t width, std::uint32_t height, std::span<const float> variances,
                                        std::span<const float> samples, const Neighbors& neighbors) {
  std::vector<Pool> pools(variances.size());
  for (std::size_t i = 0; i < pools.size(); ++i) {
    if (variances[i] >= 0) pools[i] = {std::pow(variances[i] * samples[i], kExponent), 1};
  }
  std::vector<Pool> line;
  for (std::size_t y = 0; y < height; ++y) sum_neighbors(pools, y * width, width, 1, neighbors.reach, line);
  for (std::size_t x = 0; x < width; ++x) sum_neighbors(pools, x, height, width, neighbors.reach, line);

  std::vector<float> intervals(variances.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (!(pools[i].pixels > 0) || !(samples[i] > 0)) continue;
    const float around = std::pow(pools[i].power / pools[i].pixels, 1 / kExponent) / samples[i];
    const float own = variances[i] >= 0 ? variances[i] : around;
    intervals[i] = kNormal * std::sqrt(own + neighbors.share * (around - own));
  }
  return intervals;
}

double error_uncertainty(double pixels) {
  // Student's t at 97.5 %, by its expansion in the normal distribution's (Fisher and Cornish, 1960); the last term makes it
  // right for one degree of freedom and keeps it within 1.5 % for more.
  constexpr double z = static_cast<double>(kNormal), z2 = z * z;
  constexpr double k1 = z * (z2 + 1) / 4, k2 = z * ((5 * z2 + 16) * z2 + 3) / 96,
                   k3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384, k4 = 12.7062 - z - k1 - k2 - k3;
  const double n = std::max(pixels, 1.0);
  const double t = z + (k1 + (k2 + (k3 + k4 / n) / n) / n) / n;
  // The root of F with n degrees of freedom on both sides (Cacoullos, A Relation between t and F-Distributions, 1965).
  return std::exp(std::asinh(t / std::sqrt(n)));
}

}  // namespace norrsken
