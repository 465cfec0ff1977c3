// Pearson's test: are counts what a density says?
#pragma once

#include <array>
#include <span>
#include <vector>

namespace norrsken::statistics {

using Point = std::array<double, 2>;

/// [low, high) in two coordinates.
struct Rectangle {
  Point low, high;

  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
};

/// How many samples are expected, and found, in a part of what is sampled.
struct Cell {
  Rectangle bounds;
  double expected = 0, observed = 0;
};

struct ChiSquare {
  double statistic = 0;
  double freedom = 0;    ///< 0: a single cell, which says nothing
  double tail_prob = 1;  ///< of a statistic so large if the density is right
  Cell worst;            ///< contributes most
};

/// Cells in which few samples are expected are pooled until at least kLeastExpected are, because the statistic follows
/// its distribution only then (Cochran 1954 asks for 5).
inline constexpr double kLeastExpected = 10;
ChiSquare chi_square(std::span<const Cell> cells);

/// Probability that chi-square with `freedom` > 0 degrees of freedom exceeds `statistic` >= 0.
double chi_square_tail(double statistic, double freedom);

/// `count` cells in a row, of which each expects its share of the observations: for distributions over numbers, where
/// cell i is [i, i + 1).
std::vector<Cell> cells_of_counts(std::span<const double> observed, std::span<const double> probs);

/// A rectangle in `columns` x `rows` equal cells, in each of which as many samples are expected as in every other.
class EvenCells {
 public:
  EvenCells(const Rectangle& domain, int columns, int rows);

  /// Points outside are counted in the nearest cell.
  void add(const Point& p);
  /// With what is expected of the samples added so far.
  std::vector<Cell> cells() const;

 private:
  Rectangle domain_;
  std::array<int, 2> size_;
  std::vector<double> counts_;
};

}  // namespace norrsken::statistics
