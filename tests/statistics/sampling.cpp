#include "tests/statistics/sampling.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace norrsken::statistics {

Point sphere_point(const Direction& d) {
  const double r2 = d[0] * d[0] + d[1] * d[1];
  const double turn = std::atan2(d[1], d[0]) / (2 * M_PI);
  return {turn >= 0.5 ? -0.5 : turn, std::copysign(std::min(1.0, std::sqrt(r2 / (1 + std::abs(d[2])))), d[2])};
}

Direction sphere_direction(const Point& p) {
  const double h2 = p[1] * p[1], r = std::abs(p[1]) * std::sqrt(2 - h2), phi = 2 * M_PI * p[0];
  return {r * std::cos(phi), r * std::sin(phi), std::copysign(1 - h2, p[1])};
}

Sampling sampling_of_directions(std::function<std::optional<Direction>(Random&)> sample,
                                std::function<double(const Direction&)> pdf_sa) {
  return {
      kSphere,
      {"azimuth in turns", "sqrt(1 - |z|), sign of z"},
      [sample = std::move(sample)](Random& random) -> std::optional<Point> {
        const auto direction = sample(random);
        return direction ? std::optional(sphere_point(*direction)) : std::nullopt;
      },
      [pdf_sa = std::move(pdf_sa)](const Point& p) { return 4 * M_PI * std::abs(p[1]) * pdf_sa(sphere_direction(p)); }};
}

Partition::Partition(const Rectangle& domain, std::vector<Point> pilots) : pilots_(std::move(pilots)) {
  nodes_.push_back({{domain}, pilots_});
  split(0, 0);
}

void Partition::split(std::size_t node, int depth) {
  constexpr int kMaxDepth = 48, kPilotsPerCell = 60;
  // The sphere first falls into its hemispheres: densities jump at the horizon.
  const std::span<Point> pilots = nodes_[node].pilots;
  if (depth > 0 && (pilots.size() < kPilotsPerCell || depth == kMaxDepth)) return;
  const Rectangle bounds = nodes_[node].cell.bounds;
  const std::size_t axis = bounds.high[1] - bounds.low[1] >= bounds.high[0] - bounds.low[0] ? 1 : 0;
  const double middle = (bounds.low[axis] + bounds.high[axis]) / 2;
  Rectangle below = bounds, above = bounds;
  below.high[axis] = above.low[axis] = middle;
  const auto parting = std::partition(pilots.begin(), pilots.end(), [&](const Point& p) { return p[axis] < middle; });
  const std::size_t first = nodes_.size();
  nodes_[node].axis = axis, nodes_[node].below = first;
  nodes_.push_back({{below}, {pilots.begin(), parting}});
  nodes_.push_back({{above}, {parting, pilots.end()}});
  split(first, depth + 1);
  split(first + 1, depth + 1);
}

Cell& Partition::find(const Point& p) {
  std::size_t i = 0;
  while (nodes_[i].below != 0) {
    const Node& n = nodes_[i];
    const double middle = (n.cell.bounds.low[n.axis] + n.cell.bounds.high[n.axis]) / 2;
    i = p[n.axis] < middle ? n.below : n.below + 1;
  }
  return nodes_[i].cell;
}

std::vector<Cell> Partition::cells() const {
  std::vector<Cell> leaves;
  for (const Node& n : nodes_) {
    if (n.below == 0) leaves.push_back(n.cell);
  }
  return leaves;
}

namespace {

/// Gauss' rule of 4 x 4 points.
double gauss(const std::function<double(const Point&)>& density, const Rectangle& part) {
  constexpr double kNodes[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double kWeights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      sum += kWeights[i] * kWeights[k] *
             density({part.low[0] + (part.high[0] - part.low[0]) * (kNodes[i] + 1) / 2,
                      part.low[1] + (part.high[1] - part.low[1]) * (kNodes[k] + 1) / 2});
    }
  }
  return sum * part.area() / 4;
}

bool contains(const Rectangle& r, const Point& p) {
  return p[0] >= r.low[0] && p[0] < r.high[0] && p[1] >= r.low[1] && p[1] < r.high[1];
}

/// Refined until the quarters agree with the whole, and do not miss what the pilots have found.
double refine(const std::function<double(const Point&)>& density, const Rectangle& part, double whole,
              std::span<const Point> pilots, double pilot_prob, int depth) {
  constexpr double kTolerance = 1e-6;
  constexpr int kMaxDepth = 10;
  Rectangle quarters[4];
  double values[4], sum = 0;
  for (int i = 0; i < 4; ++i) {
    quarters[i] = part;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      ((i >> axis & 1) ? quarters[i].low : quarters[i].high)[axis] = (part.low[axis] + part.high[axis]) / 2;
    }
    sum += values[i] = gauss(density, quarters[i]);
  }
  const bool missed = sum < 0.1 * pilot_prob * static_cast<double>(pilots.size());
  if ((std::abs(sum - whole) < kTolerance && !missed) || depth == kMaxDepth) return sum;
  sum = 0;
  std::vector<Point> there;
  for (int i = 0; i < 4; ++i) {
    there.clear();
    std::ranges::copy_if(pilots, std::back_inserter(there), [&](const Point& p) { return contains(quarters[i], p); });
    sum += refine(density, quarters[i], values[i], there, pilot_prob, depth + 1);
  }
  return sum;
}

}  // namespace

double integrate(const std::function<double(const Point&)>& density, const Rectangle& part,
                 std::span<const Point> pilots, double pilot_prob) {
  return refine(density, part, gauss(density, part), pilots, pilot_prob, 0);
}

Counted count(const Sampling& sampling) {
  constexpr int kPilots = 20'000;
  std::vector<Point> pilots;
  Random pilot_random(6), random(5);
  for (int i = 0; i < kPilots; ++i) {
    if (const auto p = sampling.sample(pilot_random)) pilots.push_back(*p);
  }
  Partition partition(sampling.domain, std::move(pilots));
  double came = 0;
  for (int i = 0; i < sampling.samples; ++i) {
    if (const auto p = sampling.sample(random)) ++came, ++partition.find(*p).observed;
  }
  Counted counted;
  partition.for_each([&](Cell& c, std::span<const Point> there) {
    counted.integral += c.expected = integrate(sampling.density, c.bounds, there, 1.0 / kPilots);
  });
  // How many come at all is a question of its own; this is about where they are.
  partition.for_each([&](Cell& c, std::span<const Point>) { c.expected *= came / counted.integral; });
  counted.cells = partition.cells();
  counted.share = came / sampling.samples;
  return counted;
}

}  // namespace norrsken::statistics
