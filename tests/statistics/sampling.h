// Samples and the density that they are said to have, over a rectangle or over the sphere of directions.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/statistics/chi_square.h"
#include "tests/statistics/random.h"

namespace norrsken::statistics {

struct Sampling {
  Rectangle domain;
  std::array<std::string, 2> axes;                      ///< what the coordinates are, for plots
  std::function<std::optional<Point>(Random&)> sample;  ///< nothing: a delta, or no sample at all
  std::function<double(const Point&)> density;          ///< per unit of the rectangle's area
  int samples = 1'000'000;
};

using Direction = std::array<double, 3>;

/// A unit direction as turns in [-1/2, 1/2) around z, and sqrt(1 - |z|) with the sign of z, which is as precise at the
/// poles as directions are. Solid angle per unit of area: 4 pi |height|.
Point sphere_point(const Direction& direction);
Direction sphere_direction(const Point& point);
inline constexpr Rectangle kSphere{{-0.5, -1}, {0.5, 1}};

Sampling sampling_of_directions(std::function<std::optional<Direction>(Random&)> sample,
                                std::function<double(const Direction&)> pdf_sa);

/// A rectangle in cells, small where pilot points are many.
class Partition {
 public:
  Partition(const Rectangle& domain, std::vector<Point> pilots);
  Partition(const Partition&) = delete;
  Partition& operator=(const Partition&) = delete;

  Cell& find(const Point& p);
  /// The leaves.
  std::vector<Cell> cells() const;
  /// f(cell, the pilots in it)
  template <class Function>
  void for_each(const Function& f) {
    for (Node& n : nodes_) {
      if (n.below == 0) f(n.cell, n.pilots);
    }
  }

 private:
  struct Node {
    Cell cell;
    std::span<Point> pilots{};
    std::size_t below = 0, axis = 0;  ///< first of the two halves, 0 for a leaf
  };
  void split(std::size_t node, int depth);

  std::vector<Point> pilots_;
  std::vector<Node> nodes_;
};

/// The integral of a density whose integral is about one or less over some rectangle around `part`, as exact as
/// densities in single precision are: edges of the density may run anywhere. `pilots` are those of its samples that fell
/// into the part, each of which stands for `pilot_prob`: where they are, narrow features are looked for.
double integrate(const std::function<double(const Point&)>& density, const Rectangle& part,
                 std::span<const Point> pilots = {}, double pilot_prob = 0);

/// Counted samples beside what the density expects.
struct Counted {
  std::vector<Cell> cells;  ///< of the samples that came
  double share = 0;         ///< of samples that came
  double integral = 0;      ///< of the density: what that share should be
};
Counted count(const Sampling& sampling);

}  // namespace norrsken::statistics
