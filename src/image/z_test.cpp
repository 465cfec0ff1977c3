#include "image/z_test.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace norrsken {
namespace {

constexpr double kSignificance = 0.01;
constexpr double kRounding = 1e-6;  ///< of a conversion between colour spaces in single precision, relative
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The z-score of a difference of the given variance; without variance any difference is infinitely many deviations.
double z_score(double difference, double variance) {
  if (difference == 0) return 0;
  return variance > 0 ? difference / std::sqrt(variance) : std::copysign(kInfinity, difference);
}

/// The noise of two images together, from their differences: what is wrong with one changes little from one pixel to the
/// next, and noise has nothing to do with that of its neighbours. So half the square of a difference's difference
/// from a neighbour's is on average the variance of both pixels' noise.
class NeighborNoise {
 public:
  NeighborNoise(int width, const std::vector<float>& a, const std::vector<float>& b)
      : width_(static_cast<std::size_t>(width)), height_(a.size() / width_), a_(a), b_(b) {}

  /// From the pixels beside it.
  double at(std::size_t pixel) const {
    const std::size_t x = pixel % width_, y = pixel / width_;
    double sum = 0;
    int count = 0;
    const auto look = [&](bool is_there, std::size_t other) {
      if (!is_there) return;
      const double change = difference_of(a_[pixel], b_[pixel]) - difference_of(a_[other], b_[other]);
      if (!std::isfinite(change)) return;
      sum += change * change / 2;
      ++count;
    };
    look(x > 0, pixel - 1);
    look(x + 1 < width_, pixel + 1);
    look(y > 0, pixel - width_);
    look(y + 1 < height_, pixel + width_);
    return count > 0 ? sum / count : 0;
  }

  /// The same, as a mean over the pixels up to two away, and no less than at the pixel: few neighbours say little.
  double around(std::size_t pixel) const {
    constexpr std::size_t kReach = 2;
    const std::size_t x = pixel % width_, y = pixel / width_;
    double sum = 0, count = 0;
    for (std::size_t v = y - std::min(y, kReach); v <= std::min(y + kReach, height_ - 1); ++v) {
      for (std::size_t u = x - std::min(x, kReach); u <= std::min(x + kReach, width_ - 1); ++u) {
        sum += at(v * width_ + u);
        ++count;
      }
    }
    return std::max(sum / count, at(pixel));
  }

 private:
  std::size_t width_, height_;
  const std::vector<float>&a_, &b_;
};

}  // namespace

std::optional<Comparison::ZTest> z_test(int width, const Planes& a, const Planes& b, const Planes& variance_a,
                                        const Planes& variance_b) {
  const std::size_t pixels = a[0]->size();
  const bool has_a = variance_a[0] != nullptr, has_b = variance_b[0] != nullptr;
  if (!has_a && !has_b) return std::nullopt;

  using Estimated = Comparison::ZTest::Estimated;
  Comparison::ZTest result;
  result.estimated = has_a && has_b ? Estimated::neither : has_a ? Estimated::b : Estimated::a;
  std::vector<double> scores;
  scores.reserve(3 * pixels);
  double squares = 0;
  std::size_t estimates = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const NeighborNoise noise(width, *a[c], *b[c]);
    double difference_sum = 0, variance_sum = 0, noise_sum = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double of_a = has_a ? static_cast<double>((*variance_a[c])[i]) : 0.0;
      const double of_b = has_b ? static_cast<double>((*variance_b[c])[i]) : 0.0;
      if (!(of_a >= 0 && of_a < kInfinity && of_b >= 0 && of_b < kInfinity)) continue;  // unknown: nothing to test
      double variance = of_a + of_b;
      variance_sum += variance;
      if (result.estimated != Estimated::neither) {
        noise_sum += noise.at(i);
        variance = std::max(variance, noise.around(i));
      }
      const double difference = difference_of((*a[c])[i], (*b[c])[i]);
      // Where no noise is, what another encoding of the same colour rounds off is no difference.
      const double rounding = kRounding * std::max(std::abs((*a[c])[i]), std::abs((*b[c])[i]));
      const double z = variance == 0 && std::abs(difference) <= rounding ? 0 : z_score(difference, variance);
      scores.push_back(z);
      difference_sum += difference;
      if (variance > 0) {
        squares += z * z;
        ++estimates;
      }
    }
    result.mean_z[c] = z_score(difference_sum, std::max(variance_sum, noise_sum));
  }
  if (scores.empty()) return std::nullopt;

  // Sidak: each of n independent tests at this level rejects nothing with probability 1 - kSignificance in all.
  const double level = -std::expm1(std::log1p(-kSignificance) / static_cast<double>(scores.size()));
  const auto passed = std::ranges::count_if(
      scores, [level](double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2) >= level; });
  result.passed_share = static_cast<double>(passed) / static_cast<double>(scores.size());
  result.rms_z = estimates > 0 ? std::sqrt(squares / static_cast<double>(estimates)) : 0.0;
  return result;
}

}  // namespace norrsken
