#include "accel/bvh/binary_tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "accel/bvh/fork.h"
#include "tables/bvh_tables.h"

namespace norrsken {
namespace {

constexpr int kBins = 16;

/// From this depth on references are halved by number, whatever the heuristic says: 2^32 of them end within 32 levels.
constexpr std::uint32_t kHeuristicLevels = kBvhMostLevels - 33;

/// Along the axes; the fourth component is idle.
using Float4 = float __attribute__((vector_size(16)));

struct Bounds {
  Float4 lower, upper;
};

Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
Float4 max(Float4 a, Float4 b) { return a < b ? b : a; }

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr Bounds kEmpty{{kInfinite, kInfinite, kInfinite, kInfinite}, {-kInfinite, -kInfinite, -kInfinite, -kInfinite}};

void extend(Bounds& a, const Bounds& b) { a = {min(a.lower, b.lower), max(a.upper, b.upper)}; }

/// Of a reference; the fourth components are zero.
Bounds box_of(const TriangleReference& r) {
  return {Float4{r.lower[0], r.lower[1], r.lower[2], 0.0f}, Float4{r.upper[0], r.upper[1], r.upper[2], 0.0f}};
}

float half_area(const Bounds& b) {
  const Float4 d = b.upper - b.lower;
  return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

struct Bin {
  Bounds box = kEmpty;
  std::uint32_t count = 0;
};

/// Where the middles of references fall: along each axis into bins of equal width.
struct Binning {
  Float4 first{}, per_width{};  ///< of twice the middles

  explicit Binning(const Bounds& middles) : first(middles.lower) {
    const Float4 extent = middles.upper - middles.lower;
    for (int k = 0; k < 3; ++k) {
      // The factor keeps the last middle out of a bin behind the last.
      const float bins_per_width = 0.9999f * kBins / extent[k];
      if (extent[k] > 0.0f && std::isfinite(bins_per_width)) per_width[k] = bins_per_width;
    }
  }
  bool divides(int axis) const { return per_width[axis] > 0.0f; }
  /// The bins along all axes.
  auto bins_of(const Bounds& b) const {
    using Int4 = std::int32_t __attribute__((vector_size(16)));
    return __builtin_convertvector((b.lower + b.upper - first) * per_width, Int4);
  }
};

struct Split {
  int axis = -1;  ///< -1: none
  int bin = 0;    ///< the first on the right
};

class TreeBuilder {
 public:
  explicit TreeBuilder(BinaryTree& tree) : references_(tree.references.data()), nodes_(tree.nodes.data()) {}

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::uint32_t depth, int threads) {
    Bounds box = kEmpty, middles = kEmpty;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Bounds b = box_of(references_[i]);
      extend(box, b);
      extend(middles, {b.lower + b.upper, b.lower + b.upper});
    }
    BinaryNode& n = nodes_[node];
    for (int k = 0; k < 3; ++k) n.lower[k] = box.lower[k], n.upper[k] = box.upper[k];
    n.first = begin;
    n.count = end - begin;
    if (n.count == 1) return;
    const std::uint32_t middle = partition(begin, end, depth, middles);
    const auto left = [&](int mine) { build(node + 1, begin, middle, depth + 1, mine); };
    const auto right = [&](int mine) { build(node + 2 * (middle - begin), middle, end, depth + 1, mine); };
    fork(threads_worth(n.count, threads), left, right);
  }

 private:
  /// Where the right half begins.
  std::uint32_t partition(std::uint32_t begin, std::uint32_t end, std::uint32_t depth, const Bounds& middles) {
    const std::uint32_t half = begin + (end - begin) / 2;
    if (end - begin == 2 || depth >= kHeuristicLevels) return half;
    const Binning binning(middles);
    const Split split = best_split(begin, end, binning);
    if (split.axis < 0) return half;
    const TriangleReference* right =
        std::partition(references_ + begin, references_ + end,
                       [&](const TriangleReference& r) { return binning.bins_of(box_of(r))[split.axis] < split.bin; });
    return static_cast<std::uint32_t>(right - references_);
  }

  Split best_split(std::uint32_t begin, std::uint32_t end, const Binning& binning) const {
    Bin bins[3][kBins];
    for (std::uint32_t i = begin; i < end; ++i) {
      const Bounds b = box_of(references_[i]);
      const auto at = binning.bins_of(b);
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][at[axis]];
        extend(bin.box, b);
        ++bin.count;
      }
    }
    Split best;
    float least = kInfinite;
    for (int axis = 0; axis < 3; ++axis) {
      if (!binning.divides(axis)) continue;
      float right_cost[kBins];
      Bin right;
      for (int i = kBins - 1; i > 0; --i) {
        extend(right.box, bins[axis][i].box);
        right.count += bins[axis][i].count;
        right_cost[i] = right.count > 0 ? half_area(right.box) * static_cast<float>(right.count) : kInfinite;
      }
      Bin left;
      for (int i = 1; i < kBins; ++i) {
        extend(left.box, bins[axis][i - 1].box);
        left.count += bins[axis][i - 1].count;
        if (left.count == 0) continue;
        const float cost = half_area(left.box) * static_cast<float>(left.count) + right_cost[i];
        if (cost < least) least = cost, best = {axis, i};
      }
    }
    return best;
  }

  TriangleReference* references_;
  BinaryNode* nodes_;
};

}  // namespace

Array<TriangleReference> triangle_references(const SceneTables& scene) {
  Array<TriangleReference> references;
  references.reserve(scene.triangle_count());
  for (std::uint32_t i = 0; i < scene.triangle_count(); ++i) {
    TriangleReference r{{kInfinite, kInfinite, kInfinite}, i, {-kInfinite, -kInfinite, -kInfinite}, 0};
    bool can_be_met = true;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const float* p = scene.positions.data() + std::size_t{3} * scene.triangle_vertices[std::size_t{3} * i + corner];
      for (int k = 0; k < 3; ++k) {
        can_be_met = can_be_met && std::abs(p[k]) < kLargestCoordinate;
        r.lower[k] = std::min(r.lower[k], p[k]);
        r.upper[k] = std::max(r.upper[k], p[k]);
      }
    }
    if (can_be_met) references.push_back(r);
  }
  return references;
}

BinaryTree build_binary_tree(Array<TriangleReference> references, int threads) {
  BinaryTree tree;
  tree.references = std::move(references);
  const auto count = static_cast<std::uint32_t>(tree.references.size());
  if (count == 0) return tree;
  tree.nodes.resize(std::size_t{2} * count - 1);
  TreeBuilder(tree).build(0, 0, count, 1, threads);
  return tree;
}

}  // namespace norrsken
