#include "color/spectrum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "color/cie_tables.h"

namespace norrsken {
namespace {

CieRow row_at(double wavelength) {
  if (!(wavelength >= kCieFirstWavelength && wavelength <= kCieLastWavelength)) return {};
  const double position = (wavelength - kCieFirstWavelength) / kCieStep;
  const auto i = std::min(static_cast<std::size_t>(position), kCieTable.size() - 2);
  const CieRow &a = kCieTable[i], &b = kCieTable[i + 1];
  const double t = position - static_cast<double>(i);
  return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t), std::lerp(a.z, b.z, t), std::lerp(a.d65, b.d65, t)};
}

bool is_constant(SpectrumSamples samples) { return samples.size() == 1 && samples[0].first == 0; }

constexpr std::pair<double, double> kFlat[] = {{kCieFirstWavelength, 1}, {kCieLastWavelength, 1}};

/// The integral of spectrum times colour matching functions, and times D65 if `daylight`; XYZ, not normalised. Between
/// neighbouring wavelengths of either table the integrand is a cubic, for which Simpson's rule is exact.
ColorVector integrate(SpectrumSamples samples, bool daylight) {
  std::vector<double> knots;
  for (std::size_t i = 0; i < kCieTable.size(); ++i) knots.push_back(kCieFirstWavelength + kCieStep * double(i));
  for (const auto& sample : samples) knots.push_back(sample.first);
  std::sort(knots.begin(), knots.end());

  ColorVector sum{};
  std::size_t piece = 0;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double a = knots[i], b = knots[i + 1];
    if (a < std::max(kCieFirstWavelength, samples.front().first)) continue;
    if (b > std::min(kCieLastWavelength, samples.back().first)) break;
    if (!(b > a)) continue;
    while (samples[piece + 1].first <= a) ++piece;
    const auto& [w0, v0] = samples[piece];
    const auto& [w1, v1] = samples[piece + 1];
    for (const auto& [w, weight] : {std::pair(a, 1.0), std::pair((a + b) / 2, 4.0), std::pair(b, 1.0)}) {
      const CieRow row = row_at(w);
      const double factor = weight * (b - a) / 6 * std::lerp(v0, v1, (w - w0) / (w1 - w0)) * (daylight ? row.d65 : 1.0);
      sum[0] += factor * row.x;
      sum[1] += factor * row.y;
      sum[2] += factor * row.z;
    }
  }
  return sum;
}

}  // namespace

ColorVector cie_matching(double wavelength) {
  const CieRow row = row_at(wavelength);
  return {row.x, row.y, row.z};
}

ColorVector rgb_of_reflectance(SpectrumSamples samples) {
  if (is_constant(samples)) return {samples[0].second, samples[0].second, samples[0].second};
  // sRGB's white is D65 as the standard rounds it, that of the table differs from it in the fourth digit.
  static const ColorVector white = kSrgbFromXyz * integrate(kFlat, true);
  ColorVector rgb = kSrgbFromXyz * integrate(samples, true);
  for (int k = 0; k < 3; ++k) rgb[k] /= white[k];
  return rgb;
}

ColorVector rgb_of_emission(SpectrumSamples samples) {
  static const ColorVector equal_energy = integrate(kFlat, false);
  const bool constant = is_constant(samples);
  ColorVector xyz = constant ? equal_energy : integrate(samples, false);
  for (double& component : xyz) component *= (constant ? samples[0].second : 1.0) / equal_energy[1];
  return kSrgbFromXyz * xyz;
}

double blackbody_radiance(double wavelength, double temperature) {
  constexpr double kPlanck = 6.62607015e-34, kLightSpeed = 299792458, kBoltzmann = 1.380649e-23;
  const double length = wavelength * 1e-9;
  const double per_meter = 2 * kPlanck * kLightSpeed * kLightSpeed / std::pow(length, 5) /
                           std::expm1(kPlanck * kLightSpeed / (length * kBoltzmann * temperature));
  return per_meter * 1e-9;
}

}  // namespace norrsken
