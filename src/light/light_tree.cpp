// The tree over the lights of a scene that src/light/light_tree.h goes down.
//
// Source      Conty Estevez and Kulla 2018 (see there): union of cones (algorithm 1), measure of orientation and cost of
//             a split (section 4.4)
// Departures  a node's intensity is its lights' power over the mean of how far they face a direction, so that bounds of
//             all normals do not make lights that shine elsewhere brighter; the bounds' squared diagonal stands in place of their surface, which is 0 for lights in a row
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "compile/light_choice.h"

namespace norrsken {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kBins = 12;
/// Nodes of more lights are split along their longest side, without a look at the others.
constexpr std::size_t kManyLights = 4096;
/// Of the root's radius: no light's bounds count as smaller. Keeps importance finite beside points.
constexpr double kSmallest = 1e-6;
/// Of the power, what is dealt out by the number of its lights: a weak light nearby is not left to chance.
constexpr double kEven = 0.1;
/// Emission that ends at once, in radians: no slope is steeper.
constexpr double kNarrowest = 1e-2;

struct Cone {
  glm::dvec3 axis;
  double angle;
};

glm::dvec3 turn(const glm::dvec3& v, const glm::dvec3& about, double angle) {
  return v * std::cos(angle) + glm::cross(about, v) * std::sin(angle);  // at right angles
}

Cone unite(Cone a, Cone b) {
  if (a.angle < b.angle) std::swap(a, b);
  const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
  if (std::min(between + b.angle, kPi) <= a.angle) return a;
  const double angle = (a.angle + between + b.angle) / 2;
  const glm::dvec3 normal = glm::cross(a.axis, b.axis);
  const double length = glm::length(normal);
  if (angle >= kPi || !(length > 0)) return {a.axis, kPi};
  return {glm::normalize(turn(a.axis, normal / length, angle - a.angle)), angle};
}

struct Cluster : LightBounds {
  double power;   ///< each light's times its weight
  double weight;  ///< of all lights
};

void extend(Cluster& a, const Cluster& b) {
  const Cone cone = a.power > 0 ? unite({a.axis, a.normals}, {b.axis, b.normals}) : Cone{b.axis, b.normals};
  a.lower = glm::min(a.lower, b.lower), a.upper = glm::max(a.upper, b.upper);
  a.axis = cone.axis, a.normals = cone.angle;
  a.emission = std::max(a.emission, b.emission);
  a.power += b.power, a.weight += b.weight;
}

Cluster no_lights() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return {{.lower = glm::dvec3(kFar), .upper = glm::dvec3(-kFar), .emission = 0}, 0, 0};
}

/// How far the lights of a node face a direction, from 0 to 1, in the mean over all directions: 1/4 of a plane.
double mean_facing(double normals, double emission) {
  const double dark = std::cos(emission), w = std::min(emission, kPi - normals);
  const double slope = ((std::cos(normals) - std::cos(normals + 2 * w)) / 2 + w * std::sin(normals)) / 2;
  const double floor = dark * (std::cos(normals) - std::cos(normals + w));
  return ((1 - std::cos(normals)) + (slope - floor) / (1 - dark)) / 2;
}

/// The integral of how much a cone of normals with their emission reaches of each direction.
double orientation_measure(const Cluster& b) {
  const double o = b.normals, w = std::min(o + b.emission, kPi);
  return 2 * kPi * (1 - std::cos(o)) +
         kPi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

double cost(const Cluster& b) {
  const glm::dvec3 size = b.upper - b.lower;
  return b.power > 0 ? b.power * orientation_measure(b) * glm::dot(size, size) : 0;
}

/// Of [0, 1], in steps of 1 / last.
std::uint32_t in_steps(double value, double last) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * last));
}

/// The upper half of a float not below the value.
std::uint32_t upper_half(double value) {
  return (std::bit_cast<std::uint32_t>(static_cast<float>(value)) + 0xffffu) & 0xffff0000u;
}

class TreeBuilder {
 public:
  TreeBuilder(SceneTables& tables, Array<Cluster> bounds, Array<std::uint32_t> lights)
      : tables_(tables), bounds_(std::move(bounds)), lights_(std::move(lights)) {
    order_.resize(lights_.size());
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void build() {
    tables_.light_nodes.reserve(2 * order_.size());
    tables_.light_nodes.resize(1);
    const Cluster all = bounds_of(0, order_.size());
    const double diameter2 = glm::dot(all.upper - all.lower, all.upper - all.lower);
    radius2_ = diameter2 > 0 ? diameter2 / 4 : 1;
    total_ = all.power, total_weight_ = all.weight;
    fill(0, kNone, 0, order_.size());
  }

 private:
  Cluster bounds_of(std::size_t begin, std::size_t end) const {
    Cluster all = no_lights();
    for (std::size_t i = begin; i < end; ++i) extend(all, bounds_[order_[i]]);
    return all;
  }

  /// Twice its middle.
  glm::dvec3 middle(std::uint32_t light) const { return bounds_[light].lower + bounds_[light].upper; }

  void fill(std::uint32_t index, std::uint32_t parent, std::size_t begin, std::size_t end) {
    const Cluster bounds = bounds_of(begin, end);
    LightNode node = make_node(bounds);
    node.parent = parent;
    if (end - begin == 1) {
      const std::uint32_t light = lights_[order_[begin]];
      node.content = kLightLeafBit | light;
      tables_.light_leaves[light] = index;
      tables_.light_nodes[index] = node;
      return;
    }
    node.content = static_cast<std::uint32_t>(tables_.light_nodes.size());
    tables_.light_nodes[index] = node;
    tables_.light_nodes.resize(tables_.light_nodes.size() + 2);
    const std::size_t split = split_of(begin, end);
    fill(node.content, index, begin, split);
    fill(node.content + 1, index, split, end);
  }

  LightNode make_node(const Cluster& b) const {
    const glm::dvec3 center = (b.lower + b.upper) / 2.0, half = (b.upper - b.lower) / 2.0;
    const double radius2 = std::max(glm::dot(half, half), kSmallest * kSmallest * radius2_);
    const double emission = std::max(b.emission, kNarrowest), dark = std::cos(emission);
    LightNode node{};
    for (int i = 0; i < 3; ++i) {
      node.center[i] = static_cast<float>(center[i]);
      node.axis |= in_steps((b.axis[i] + 1) / 2, 1022) << 10 * i;
    }
    node.normals = in_steps((std::cos(b.normals) + 1) / 2, 65535) | in_steps(std::sin(b.normals), 65535) << 16;
    node.extent = upper_half(radius2) | upper_half(1 / (1 - dark)) >> 16;
    // The lights' power, as if all shone alike, into where they face; in units of the whole, which stay in a float's
    // range at any scale.
    const double power = (1 - kEven) * b.power / total_ + kEven * b.weight / total_weight_;
    node.intensity = static_cast<float>(power / mean_facing(b.normals, emission) * radius2_);
    return node;
  }

  /// Sorts [begin, end) into two halves, neither empty.
  std::size_t split_of(std::size_t begin, std::size_t end) {
    glm::dvec3 lower = middle(order_[begin]), upper = lower;
    for (std::size_t i = begin; i < end; ++i) {
      lower = glm::min(lower, middle(order_[i])), upper = glm::max(upper, middle(order_[i]));
    }
    const glm::dvec3 size = upper - lower;
    const double longest = std::max({size.x, size.y, size.z});
    double best = std::numeric_limits<double>::infinity();
    int best_axis = 0;
    std::size_t best_bin = 0;
    const auto bin_of = [&](std::uint32_t light, int axis) {
      const double place = (middle(light)[axis] - lower[axis]) / size[axis];
      return std::min(static_cast<std::size_t>(place * static_cast<double>(kBins)), kBins - 1);
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(size[axis] > 0) || (end - begin > kManyLights && size[axis] < longest)) continue;
      std::array<Cluster, kBins> bins;
      bins.fill(no_lights());
      for (std::size_t i = begin; i < end; ++i) extend(bins[bin_of(order_[i], axis)], bounds_[order_[i]]);
      std::array<double, kBins> above{};  // the cost of bin k and all above it
      Cluster sum = no_lights();
      for (std::size_t k = kBins; k-- > 0;) {
        if (bins[k].power > 0) extend(sum, bins[k]);
        above[k] = cost(sum);
      }
      sum = no_lights();
      // Long thin halves are no better for having little area.
      const double thinness = longest / size[axis];
      for (std::size_t k = 0; k + 1 < kBins; ++k) {
        if (bins[k].power > 0) extend(sum, bins[k]);
        // The first and the last bin hold a light each, so neither side is empty.
        const double of_split = thinness * (cost(sum) + above[k + 1]);
        if (of_split < best) best = of_split, best_axis = axis, best_bin = k;
      }
    }
    if (!(best < std::numeric_limits<double>::infinity())) return begin + (end - begin) / 2;
    const auto first = order_.begin();
    const auto split =
        std::partition(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
                       [&](std::uint32_t light) { return bin_of(light, best_axis) <= best_bin; });
    return static_cast<std::size_t>(split - first);
  }

  SceneTables& tables_;
  Array<Cluster> bounds_;
  Array<std::uint32_t> lights_;  ///< their indices in the tables
  Array<std::uint32_t> order_;
  double radius2_ = 1, total_ = 1, total_weight_ = 1;
};

/// The alias table of the lights around the scene, by their shares, and of the tree, which has those of all the others.
void fill_lights_around(SceneTables& tables, std::span<const LightPower> lights) {
  const std::vector<double> all_shares = shares_of_choice(lights);
  std::vector<LightRecord> cells;
  std::vector<double> shares;
  double of_tree = 0;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (!(lights[i].per_cross_section > 0)) {
      of_tree += all_shares[i];
    } else if (all_shares[i] > 0) {
      tables.lights_around.push_back({i, kNone, 1, 1});
      shares.push_back(all_shares[i]);
    }
  }
  tables.lights_around.push_back({kNone, kNone, 1, 1});
  shares.push_back(of_tree);
  cells.resize(shares.size());
  fill_alias_table(cells, shares);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    AroundLight& cell = tables.lights_around[i];
    cell.alias = tables.lights_around[cells[i].alias].light;
    cell.keep = cells[i].alias_prob, cell.prob = cells[i].prob;
  }
}

}  // namespace

void build_light_tree(SceneTables& tables, std::span<const LightPower> lights) {
  tables.light_nodes.clear(), tables.lights_around.clear();
  tables.light_leaves.assign(lights.size(), kNone);
  Array<Cluster> bounds;
  Array<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (!(lights[i].own > 0 && lights[i].weight > 0)) continue;
    bounds.push_back({lights[i].bounds, lights[i].own * lights[i].weight, lights[i].weight});
    indices.push_back(i);
  }
  fill_lights_around(tables, lights);
  if (!indices.empty()) TreeBuilder(tables, std::move(bounds), std::move(indices)).build();
}

}  // namespace norrsken
