#include "accel/bvh/layout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "accel/bvh/fork.h"
#include "base/huge_pages.h"

namespace norrsken {
namespace {

/// What a ray pays for a node and for a block, measured.
constexpr float kNodeCost = 1.0f, kBlockCost = 1.4f;
constexpr float kInfinite = std::numeric_limits<float>::infinity();

float half_area(const BinaryNode& n) {
  const float x = n.upper[0] - n.lower[0], y = n.upper[1] - n.lower[1], z = n.upper[2] - n.lower[2];
  return x * y + y * z + z * x;
}

/// What was found to be the least cost of a subtree.
/// Three bits for each number of roots j = 2..8, at 3 (j - 2): how many of them are left of the subtree's own root when it is
/// replaced by j; 0 (never for j = 8): j - 1 are no worse. And whether it costs least as one block.
using Choice = std::uint32_t;
constexpr Choice kIsBlock = 1u << 31;

std::uint32_t roots_on_the_left(Choice choice, std::uint32_t roots) { return (choice >> (3 * (roots - 2))) & 7u; }

/// Least costs of a subtree with at most 1..7 roots.
struct Costs {
  float of[kBvhWidth];  ///< by number of roots; [0] is not used
};

class WideTree {
 public:
  WideTree(BinaryTree& tree, Array<Choice>& choices)
      : tree_(tree), nodes_(tree.nodes.data()), choices_(choices.data()) {}

  Costs choose(std::uint32_t node, int threads) {
    const BinaryNode& n = nodes_[node];
    const float area = half_area(n);
    const float as_block = n.count <= kBvhWidth ? area * kBlockCost : kInfinite;
    Costs costs;
    Choice choice = 0;
    if (n.count == 1) {
      std::fill(std::begin(costs.of), std::end(costs.of), as_block);
      choices_[node] = kIsBlock;
      return costs;
    }
    Costs left, right;
    fork(
        threads_worth(n.count, threads), [&](int mine) { left = choose(BinaryTree::left(node), mine); },
        [&](int mine) { right = choose(tree_.right(node), mine); });
    float least[kBvhWidth + 1];
    std::uint32_t split[kBvhWidth + 1];
    for (std::uint32_t roots = 2; roots <= kBvhWidth; ++roots) {
      least[roots] = kInfinite;
      split[roots] = 1;
      for (std::uint32_t k = 1; k < roots; ++k) {
        const float cost = left.of[k] + right.of[roots - k];
        if (cost < least[roots]) least[roots] = cost, split[roots] = k;
      }
    }
    const float as_node = area * kNodeCost + least[kBvhWidth];
    if (n.count <= kBvhWidth && as_block <= as_node) choice |= kIsBlock;
    costs.of[1] = std::min(as_block, as_node);
    for (std::uint32_t roots = 2; roots < kBvhWidth; ++roots) {
      costs.of[roots] = costs.of[roots - 1];
      if (least[roots] < costs.of[roots]) {
        costs.of[roots] = least[roots];
        choice |= split[roots] << (3 * (roots - 2));
      }
    }
    choice |= split[kBvhWidth] << (3 * (kBvhWidth - 2));
    choices_[node] = choice;
    return costs;
  }

  bool is_block(std::uint32_t node) const { return (choices_[node] & kIsBlock) != 0; }

  struct Children {
    std::uint32_t node[kBvhWidth];
    std::uint32_t count = 0;
  };
  Children children_of(std::uint32_t node) const {
    Children children;
    const std::uint32_t on_the_left = roots_on_the_left(choices_[node], kBvhWidth);
    collect(BinaryTree::left(node), on_the_left, children);
    collect(tree_.right(node), kBvhWidth - on_the_left, children);
    // Rays that look for any hit go to the last child first: to the largest, which hides most.
    std::stable_sort(children.node, children.node + children.count,
                     [&](std::uint32_t a, std::uint32_t b) { return half_area(nodes_[a]) < half_area(nodes_[b]); });
    return children;
  }

  /// How many lines the wide node and all below it take; remembered in `first`, which only blocks need otherwise.
  std::uint32_t count_lines(std::uint32_t node, int threads) {
    if (is_block(node)) return kBlockLines;
    const Children children = children_of(node);
    std::uint32_t lines[kBvhWidth];
    count_children(children, 0, children.count, lines, threads_worth(nodes_[node].count, threads));
    std::uint32_t sum = kNodeLines;
    for (std::uint32_t i = 0; i < children.count; ++i) sum += lines[i];
    nodes_[node].first = sum;
    return sum;
  }

  static constexpr std::uint32_t kNodeLines = sizeof(BvhNode) / sizeof(CacheLine);
  static constexpr std::uint32_t kBlockLines = sizeof(TriangleBlock) / sizeof(CacheLine);

 private:
  void count_children(const Children& children, std::uint32_t begin, std::uint32_t end, std::uint32_t* lines,
                      int threads) {
    if (end - begin == 1) {
      lines[begin] = count_lines(children.node[begin], threads);
      return;
    }
    const std::uint32_t middle = (begin + end) / 2;
    fork(
        threads, [&](int mine) { count_children(children, begin, middle, lines, mine); },
        [&](int mine) { count_children(children, middle, end, lines, mine); });
  }

  void collect(std::uint32_t node, std::uint32_t roots, Children& children) const {
    const Choice choice = choices_[node];
    while (roots > 1 && (nodes_[node].count == 1 || roots_on_the_left(choice, roots) == 0)) --roots;
    if (roots == 1) {
      children.node[children.count++] = node;
      return;
    }
    const std::uint32_t on_the_left = roots_on_the_left(choice, roots);
    collect(BinaryTree::left(node), on_the_left, children);
    collect(tree_.right(node), roots - on_the_left, children);
  }

  BinaryTree& tree_;
  BinaryNode* nodes_;
  Choice* choices_;
};

/// Writes nodes and blocks: a node, its blocks, then what is below its other children, each in one piece.
class Writer {
 public:
  Writer(const SceneTables& scene, const BinaryTree& tree, std::span<const std::uint32_t> primitives,
         const WideTree& wide, CacheLine* lines)
      : scene_(scene), tree_(tree), primitives_(primitives), wide_(wide), lines_(lines) {}

  void write_node(std::uint32_t node, std::uint32_t line, int threads) const {
    auto& to = *reinterpret_cast<BvhNode*>(lines_ + line);
    const WideTree::Children children = wide_.children_of(node);
    std::uint32_t next = line + WideTree::kNodeLines;
    for (std::uint32_t i = 0; i < kBvhWidth; ++i) {
      if (i >= children.count) {
        for (auto& axis : to.bounds) axis[0][i] = kInfinite, axis[1][i] = -kInfinite;
        to.child[i] = kBvhNothing;
        continue;
      }
      const BinaryNode& child = tree_.nodes[children.node[i]];
      set_bounds(to, i, child);
      if (!wide_.is_block(children.node[i])) continue;
      to.child[i] = kBvhLeaf | next;
      write_block(children.node[i], next);
      next += WideTree::kBlockLines;
    }
    for (std::uint32_t i = 0; i < children.count; ++i) {
      if (wide_.is_block(children.node[i])) continue;
      to.child[i] = next;
      next += tree_.nodes[children.node[i]].first;
    }
    write_children(to, children, 0, children.count, threads_worth(tree_.nodes[node].count, threads));
  }

  void write_block(std::uint32_t node, std::uint32_t line) const {
    auto& to = *reinterpret_cast<TriangleBlock*>(lines_ + line);
    const BinaryNode& n = tree_.nodes[node];
    std::uint32_t primitives[kBvhWidth];
    std::fill(std::begin(primitives), std::end(primitives), kBvhNothing);
    for (std::uint32_t i = 0; i < n.count; ++i) primitives[i] = primitives_[n.first + i];
    std::sort(std::begin(primitives), std::end(primitives));
    for (std::uint32_t i = 0; i < kBvhWidth; ++i) {
      const bool is_there = i < n.count;
      const std::uint32_t* vertices = scene_.triangle_vertices.data() + std::size_t{3} * primitives[is_there ? i : 0];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const float* p = scene_.positions.data() + std::size_t{3} * vertices[is_there ? corner : 0];
        for (std::size_t k = 0; k < 3; ++k) to.corners[k][corner][i] = p[k];
      }
      to.primitive[i] = is_there ? primitives[i] : kBvhNothing;
    }
  }

 private:
  void write_children(const BvhNode& to, const WideTree::Children& children, std::uint32_t begin, std::uint32_t end,
                      int threads) const {
    if (end - begin == 1) {
      if (!wide_.is_block(children.node[begin])) write_node(children.node[begin], to.child[begin], threads);
      return;
    }
    const std::uint32_t middle = (begin + end) / 2;
    fork(
        threads, [&](int mine) { write_children(to, children, begin, middle, mine); },
        [&](int mine) { write_children(to, children, middle, end, mine); });
  }

  /// Wider than the triangles by a few ulps of their size, by which rounded products of the edge functions may move an edge
  /// (cross_block.h), and by one of the coordinate, so that a ray within a plane of bounds is not outside of them.
  static void set_bounds(BvhNode& to, std::uint32_t child, const BinaryNode& from) {
    for (int k = 0; k < 3; ++k) {
      const float extent = from.upper[k] - from.lower[k];
      const auto slack = [&](float x) { return 0x1p-21f * extent + 0x1p-23f * std::abs(x); };
      to.bounds[k][0][child] = from.lower[k] - slack(from.lower[k]);
      to.bounds[k][1][child] = from.upper[k] + slack(from.upper[k]);
    }
  }

  const SceneTables& scene_;
  const BinaryTree& tree_;
  std::span<const std::uint32_t> primitives_;  ///< in the order of the tree
  const WideTree& wide_;
  CacheLine* lines_;
};

/// All that is needed of the references from then on; they take eight times as much.
Array<std::uint32_t> take_primitives(BinaryTree& tree) {
  Array<std::uint32_t> primitives(tree.references.size());
  std::ranges::transform(tree.references, primitives.begin(), &TriangleReference::primitive);
  tree.references = {};
  return primitives;
}

}  // namespace

Bvh build_bvh(const SceneTables& scene, int threads) {
  BinaryTree tree = build_binary_tree(triangle_references(scene), threads);
  Bvh bvh;
  if (tree.nodes.empty()) return bvh;
  Array<Choice> choices(tree.nodes.size());
  WideTree wide(tree, choices);
  wide.choose(0, threads);
  const Array<std::uint32_t> primitives = take_primitives(tree);
  const std::uint32_t line_count = wide.count_lines(0, threads);
  bvh.lines.reserve(line_count);
  ask_for_huge_pages(bvh.lines.data(), line_count * sizeof(CacheLine));
  bvh.lines.resize(line_count);
  const Writer writer(scene, tree, primitives, wide, bvh.lines.data());
  bvh.root = wide.is_block(0) ? kBvhLeaf : 0;
  if (bvh.root == kBvhLeaf) {
    writer.write_block(0, 0);
  } else {
    writer.write_node(0, 0, threads);
  }
  return bvh;
}

}  // namespace norrsken
