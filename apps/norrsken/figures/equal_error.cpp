#include "figures/equal_error.h"

#include <algorithm>
#include <cmath>

namespace norrsken::cli {
namespace {

double distance(const SppError& measurement, double target) { return std::abs(std::log(measurement.error / target)); }

void sort_by_distance(std::vector<SppError>& measured, double target) {
  std::stable_sort(measured.begin(), measured.end(),
                   [&](const SppError& a, const SppError& b) { return distance(a, target) < distance(b, target); });
}

}  // namespace

int predict_spp(std::vector<SppError> measured, double target) {
  constexpr double kMaxSpp = 1 << 24;
  sort_by_distance(measured, target);
  const SppError& nearest = measured.front();
  double rate = -0.5;
  const auto other = std::find_if(measured.begin(), measured.end(),
                                  [&](const SppError& m) { return m.spp != nearest.spp && m.error > 0; });
  if (other != measured.end()) {
    const double slope =
        std::log(other->error / nearest.error) / std::log(static_cast<double>(other->spp) / nearest.spp);
    if (slope >= -1.5 && slope <= -0.25) rate = slope;
  }
  const double spp = nearest.spp * std::pow(target / nearest.error, 1 / rate);
  return static_cast<int>(std::lround(std::clamp(spp, 1.0, kMaxSpp)));
}

SppError find_equal_error(double target, std::vector<SppError> measured, const std::function<double(int)>& measure,
                          double tolerance, int max_measurements) {
  for (int i = 0; i < max_measurements; ++i) {
    sort_by_distance(measured, target);
    if (std::abs(measured.front().error / target - 1) <= tolerance) break;
    const int spp = predict_spp(measured, target);
    if (std::any_of(measured.begin(), measured.end(), [&](const SppError& m) { return m.spp == spp; })) break;
    measured.push_back({spp, measure(spp)});
  }
  sort_by_distance(measured, target);
  return measured.front();
}

}  // namespace norrsken::cli
