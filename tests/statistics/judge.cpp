#include "tests/statistics/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
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

Comparison judge(const Estimate& difference, double freedom, double reference, double resolution, double level,
                 double rounding) {
  Comparison result;
  result.resolution = resolution;
  result.difference = difference.mean;
  const double allowed = rounding * std::abs(reference);
  const double excess = std::max(0.0, std::abs(difference.mean) - allowed);
  const double error = std::sqrt(difference.variance);
  if (std::isnan(difference.mean)) {
    result.sigmas = std::numeric_limits<double>::infinity();
  } else if (error == 0) {
    result.sigmas = excess > 0 ? std::copysign(std::numeric_limits<double>::infinity(), difference.mean) : 0;
    result.smallest_bias = rounding;
  } else {
    // A bias of critical + 2 standard errors is rejected unless the noise takes more than two of them away.
    constexpr double kPower = 2;
    result.sigmas = std::copysign(excess / error, difference.mean);
    result.critical = student_critical(level, freedom);
    result.smallest_bias = (allowed + (result.critical + kPower) * error) / std::abs(reference);
  }
  return result;
}

}  // namespace

Comparison compare(const Estimate& tested, const Estimate& reference, double resolution, double level,
                   double rounding) {
  const Estimate difference{tested.mean - reference.mean, tested.variance + reference.variance, 0};
  return judge(difference, degrees_of_freedom(tested, reference), reference.mean, resolution, level, rounding);
}

Comparison compare_paired(const Estimate& difference, double reference, double resolution, double level,
                          double rounding) {
  return judge(difference, difference.replicates - 1, reference, resolution, level, rounding);
}

Judge::Judge(std::string_view family)
    : family_(family), planned_(planned_comparisons(family)), level_(sidak_level(kSuiteLevel, suite_comparisons())) {}

void Judge::compare(const std::string& what, const RegionEstimates& tested, const RegionEstimates& reference) {
  for (std::size_t r = 0; r < tested.regions.size(); ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Region& region = tested.regions[r];
      add(what, region, c,
          statistics::compare(tested.values[r][c], reference.values.at(r)[c], region.resolution, level_, kRounding));
    }
  }
}

void Judge::compare_paired(const std::string& what, const RegionMeans& tested, const RegionMeans& reference) {
  const RegionEstimates differences = tested.differences(reference), scale = reference.estimates();
  for (std::size_t r = 0; r < differences.regions.size(); ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Region& region = differences.regions[r];
      add(what, region, c,
          statistics::compare_paired(differences.values[r][c], scale.values[r][c].mean, region.resolution, level_,
                                     kRounding));
    }
  }
}

void Judge::add(const std::string& what, const Region& region, std::size_t channel, Comparison comparison) {
  comparison.sort = region.sort;
  comparison.name = fmt::format("{}{}{}, {}", what, what.empty() ? "" : ": ", region.name, "RGB"[channel]);
  comparisons_.push_back(std::move(comparison));
}

::testing::AssertionResult Judge::verdict() const {
  std::vector<std::string> failures;
  std::vector<std::pair<std::string, double>> smallest_bias;  // the worst of each sort of region
  const Comparison* worst = nullptr;
  for (const Comparison& comparison : comparisons_) {
    auto bias = std::ranges::find(smallest_bias, comparison.sort, &std::pair<std::string, double>::first);
    if (bias == smallest_bias.end()) bias = smallest_bias.insert(bias, {comparison.sort, 0});
    bias->second = std::max(bias->second, comparison.smallest_bias);
    if (!worst || std::abs(comparison.sigmas) > std::abs(worst->sigmas)) worst = &comparison;
    if (!comparison.agrees()) {
      failures.push_back(fmt::format("{}: off by {:.3g}, {:.1f} sigma where {:.1f} are allowed", comparison.name,
                                     comparison.difference, comparison.sigmas, comparison.critical));
    }
    if (!comparison.resolves()) {
      failures.push_back(fmt::format("{}: could have seen a bias of {:.2f} % at best, {:.2f} % is asked for",
                                     comparison.name, 100 * comparison.smallest_bias, 100 * comparison.resolution));
    }
  }
  if (static_cast<int>(comparisons_.size()) != planned_) {
    failures.push_back(fmt::format("made {} comparisons, suite.h says {}", comparisons_.size(), planned_));
  }

  std::string summary = fmt::format("{}: {} comparisons", family_, comparisons_.size());
  if (worst) summary += fmt::format(", largest deviation {:.1f} sigma ({})", worst->sigmas, worst->name);
  const char* separator = "; smallest bias seen: ";
  for (const auto& [sort, bias] : smallest_bias) {
    summary += fmt::format("{}{} {:.3f} %", separator, sort, 100 * bias);
    separator = ", ";
  }
  fmt::print("{}\n", summary);
  if (failures.empty()) return ::testing::AssertionSuccess();
  constexpr std::size_t kShown = 20;
  const auto shown = std::span(failures).first(std::min(failures.size(), kShown));
  auto result = ::testing::AssertionFailure() << family_ << "\n  " << fmt::format("{}", fmt::join(shown, "\n  "));
  if (failures.size() > kShown) result << "\n  and " << failures.size() - kShown << " more";
  return result;
}

}  // namespace norrsken::statistics
