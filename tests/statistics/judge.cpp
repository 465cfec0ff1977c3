#include "tests/statistics/judge.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "tests/statistics/student.h"
#include "tests/statistics/suite.h"

namespace norrsken::statistics {

namespace {

/// Welch 1947 and Satterthwaite 1946: the degrees of freedom of the difference of two means.
double degrees_of_freedom(const Estimate& a, const Estimate& b) {
  const auto share = [](const Estimate& e) {
    return e.replicates > 1 ? e.variance * e.variance / (e.replicates - 1) : 0.0;
  };
  const double variance = a.variance + b.variance;
  return variance * variance / (share(a) + share(b));
}

}  // namespace

Comparison compare(const Estimate& tested, const Estimate& reference, double resolution, double level,
                   double rounding) {
  Comparison result;
  result.resolution = resolution;
  result.difference = tested.mean - reference.mean;
  const double allowed = rounding * std::abs(reference.mean);
  const double excess = std::max(0.0, std::abs(result.difference) - allowed);
  const double error = std::sqrt(tested.variance + reference.variance);
  if (error == 0) {
    result.sigmas = excess > 0 ? std::copysign(std::numeric_limits<double>::infinity(), result.difference) : 0;
    result.smallest_bias = rounding;
  } else {
    // A bias of critical + 2 standard errors is rejected unless the noise takes more than two of them away.
    constexpr double kPower = 2;
    result.sigmas = std::copysign(excess / error, result.difference);
    result.critical = student_critical(level, degrees_of_freedom(tested, reference));
    result.smallest_bias = (allowed + (result.critical + kPower) * error) / std::abs(reference.mean);
  }
  if (std::isnan(result.difference)) result.sigmas = std::numeric_limits<double>::infinity();
  return result;
}

Judge::Judge(std::string_view family)
    : family_(family), planned_(planned_comparisons(family)), level_(sidak_level(kSuiteLevel, suite_comparisons())) {}

void Judge::compare(const std::string& what, const Region& region, std::size_t channel, const Estimate& tested,
                    const Estimate& reference) {
  Comparison comparison = statistics::compare(tested, reference, region.resolution, level_, kRounding);
  comparison.sort = region.sort;
  comparison.name = fmt::format("{}{}{}, {}", what, what.empty() ? "" : ": ", region.name, "RGB"[channel]);
  comparisons_.push_back(std::move(comparison));
}

void Judge::compare(const std::string& what, const RegionMeans& tested, const RegionMeans& reference) {
  for (std::size_t r = 0; r < tested.regions().size(); ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      compare(what, tested.regions()[r], c, tested.estimate(r, c), reference.estimate(r, c));
    }
  }
}

void Judge::compare(const std::string& what, const RegionMeans& tested, const Picture& known) {
  for (std::size_t r = 0; r < tested.regions().size(); ++r) {
    const Picture::Pixel mean = region_mean(known, tested.regions()[r]);
    for (std::size_t c = 0; c < 3; ++c) {
      compare(what, tested.regions()[r], c, tested.estimate(r, c), Estimate::known(mean[c]));
    }
  }
}

::testing::AssertionResult Judge::verdict() const {
  std::string failures;
  std::map<std::string, double> smallest_bias;  // the worst of each sort of region
  const Comparison* worst = nullptr;
  for (const Comparison& comparison : comparisons_) {
    double& bias = smallest_bias[comparison.sort];
    bias = std::max(bias, comparison.smallest_bias);
    if (!worst || std::abs(comparison.sigmas) > std::abs(worst->sigmas)) worst = &comparison;
    if (!comparison.agrees()) {
      failures += fmt::format("\n  {}: off by {:.3g}, {:.1f} sigma where {:.1f} are allowed", comparison.name,
                              comparison.difference, comparison.sigmas, comparison.critical);
    }
    if (!comparison.resolves()) {
      failures += fmt::format("\n  {}: could have seen a bias of {:.2f} % at best, {:.2f} % is asked for",
                              comparison.name, 100 * comparison.smallest_bias, 100 * comparison.resolution);
    }
  }
  if (static_cast<int>(comparisons_.size()) != planned_) {
    failures += fmt::format("\n  made {} comparisons, suite.h says {}", comparisons_.size(), planned_);
  }

  std::string summary = fmt::format("{}: {} comparisons", family_, comparisons_.size());
  if (worst) summary += fmt::format(", largest deviation {:.1f} sigma ({})", worst->sigmas, worst->name);
  for (const auto& [sort, bias] : smallest_bias) {
    summary += fmt::format("; smallest bias seen, {}: {:.3f} %", sort, 100 * bias);
  }
  fmt::print("{}\n", summary);
  if (failures.empty()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << family_ << failures;
}

}  // namespace norrsken::statistics
