#include "color/spectrum.h"

#include <algorithm>
#include <cmath>

namespace norrsken {
namespace {

constexpr double kFirstWavelength = 360, kLastWavelength = 830;  // nm, the range of the CIE tables
constexpr int kSteps = 470;

// Gaussian with a width on either side of its peak, given as inverse standard deviations in 1/nm.
double lobe(double wavelength, double peak, double inverse_below, double inverse_above) {
  const double t = (wavelength - peak) * (wavelength < peak ? inverse_below : inverse_above);
  return std::exp(-0.5 * t * t);
}

bool is_constant(SpectrumSamples samples) { return samples.size() == 1 && samples[0].first == 0; }

double value_at(SpectrumSamples samples, double wavelength) {
  const auto above = std::upper_bound(samples.begin(), samples.end(), wavelength,
                                      [](double w, const auto& sample) { return w < sample.first; });
  if (above == samples.begin()) return 0;
  const auto& [w0, v0] = *(above - 1);
  if (above == samples.end()) return wavelength == w0 ? v0 : 0;
  const auto& [w1, v1] = *above;
  return v0 + (v1 - v0) * (wavelength - w0) / (w1 - w0);
}

// XYZ per unit of the integral of y, by the midpoint rule over `value(wavelength)`.
template <typename Value>
ColorVector integrate(const Value& value) {
  const double step = (kLastWavelength - kFirstWavelength) / kSteps;
  ColorVector sum{};
  double luminance = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double wavelength = kFirstWavelength + (i + 0.5) * step;
    const ColorVector matching = cie_matching(wavelength);
    const double v = value(wavelength);
    for (int k = 0; k < 3; ++k) sum[k] += matching[k] * v;
    luminance += matching[1];
  }
  for (double& component : sum) component /= luminance;
  return sum;
}

// The cone-like responses between which Bradford adapts (Lam 1985, as in ICC.1:2022 annex E).
constexpr ColorMatrix kBradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

}  // namespace

ColorVector cie_matching(double w) {
  return {1.056 * lobe(w, 599.8, 0.0264, 0.0323) + 0.362 * lobe(w, 442.0, 0.0624, 0.0374) -
              0.065 * lobe(w, 501.1, 0.0490, 0.0382),
          0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322),
          1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725)};
}

ColorVector rgb_of_reflectance(SpectrumSamples samples) {
  if (is_constant(samples)) return {samples[0].second, samples[0].second, samples[0].second};
  const ColorVector xyz = integrate([&](double wavelength) { return value_at(samples, wavelength); });
  const ColorVector white = integrate([](double) { return 1.0; });
  ColorVector cone = kBradford * xyz;
  const ColorVector cone_from = kBradford * white, cone_to = kBradford * xyz_of(kSrgbWhite);
  for (int k = 0; k < 3; ++k) cone[k] *= cone_to[k] / cone_from[k];
  return kSrgbFromXyz * (inverse(kBradford) * cone);
}

ColorVector rgb_of_emission(SpectrumSamples samples) {
  if (is_constant(samples)) return {samples[0].second, samples[0].second, samples[0].second};
  return kSrgbFromXyz * integrate([&](double wavelength) { return value_at(samples, wavelength); });
}

}  // namespace norrsken
