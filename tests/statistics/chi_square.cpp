#include "tests/statistics/chi_square.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace norrsken::statistics {

namespace {

/// P(a, x) for x < a + 1 by its series, NIST DLMF 8.11.4.
double lower_gamma_series(double a, double x, double front) {
  double term = 1 / a, sum = term;
  for (int n = 1; n < 100'000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
  return sum * front;
}

/// Q(a, x) for x >= a + 1 by its continued fraction, NIST DLMF 8.9.2, evaluated by Lentz's method.
double upper_gamma_fraction(double a, double x, double front) {
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, result = d;
  for (int n = 1; n < 100'000; ++n) {
    const double numerator = -n * (n - a);
    b += 2;
    d = numerator * d + b;
    if (std::abs(d) < kTiny) d = kTiny;
    c = b + numerator / c;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1 / d;
    result *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return result * front;
}

}  // namespace

double chi_square_tail(double statistic, double freedom) {
  const double a = freedom / 2, x = statistic / 2;
  if (x <= 0) return 1;
  if (std::isinf(x)) return 0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  return x < a + 1 ? 1 - lower_gamma_series(a, x, front) : upper_gamma_fraction(a, x, front);
}

ChiSquare chi_square(std::span<const Cell> all) {
  std::vector<Cell> cells(all.begin(), all.end());
  std::ranges::sort(cells, {}, &Cell::expected);
  ChiSquare result;
  double worst = -1;
  int compared = 0;
  const auto compare = [&](const Cell& c) {
    const double difference = c.observed - c.expected, term = difference * difference / c.expected;
    result.statistic += term, ++compared;
    if (term > worst) worst = term, result.worst = c;
  };
  Cell pool{};
  double excess = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool has_rare = i > 0 && pool.expected < kLeastExpected;
    if (cells[i].expected >= kLeastExpected && !has_rare) {
      compare(cells[i]);
      continue;
    }
    // The place of a pool is that of the cell with most samples too many.
    if (i == 0 || cells[i].observed - cells[i].expected > excess) {
      excess = cells[i].observed - cells[i].expected, pool.bounds = cells[i].bounds;
    }
    pool.expected += cells[i].expected, pool.observed += cells[i].observed;
  }
  if (pool.expected > 0) compare(pool);
  result.freedom = std::max(0, compared - 1);
  if (result.freedom > 0) result.tail_prob = chi_square_tail(result.statistic, result.freedom);
  return result;
}

std::vector<Cell> cells_of_counts(std::span<const double> observed, std::span<const double> probs) {
  double count = 0;
  for (const double n : observed) count += n;
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const auto at = static_cast<double>(i);
    cells.push_back({{{at, 0}, {at + 1, 1}}, probs[i] * count, observed[i]});
  }
  return cells;
}

EvenCells::EvenCells(const Rectangle& domain, int columns, int rows)
    : domain_(domain), size_{columns, rows}, counts_(static_cast<std::size_t>(columns * rows)) {}

void EvenCells::add(const Point& p) {
  int at[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const double share = (p[k] - domain_.low[k]) / (domain_.high[k] - domain_.low[k]);
    at[k] = std::clamp(static_cast<int>(share * size_[k]), 0, size_[k] - 1);
  }
  ++counts_[static_cast<std::size_t>(at[1] * size_[0] + at[0])];
}

std::vector<Cell> EvenCells::cells() const {
  double count = 0;
  for (const double n : counts_) count += n;
  const auto at = [&](std::size_t k, int i) {
    return domain_.low[k] + (domain_.high[k] - domain_.low[k]) * i / size_[k];
  };
  std::vector<Cell> cells;
  for (int row = 0; row < size_[1]; ++row) {
    for (int column = 0; column < size_[0]; ++column) {
      cells.push_back({{{at(0, column), at(1, row)}, {at(0, column + 1), at(1, row + 1)}},
                       count / static_cast<double>(counts_.size()),
                       counts_[static_cast<std::size_t>(row * size_[0] + column)]});
    }
  }
  return cells;
}

}  // namespace norrsken::statistics
