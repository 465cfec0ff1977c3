// A binary tree of triangles by the surface area heuristic, of which src/accel/bvh/layout.h makes the wide one.
// Sources: Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", 1987 (the heuristic); Wald,
// "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (bins).
#pragma once

#include <cstdint>

#include "base/memory.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// A triangle by its bounds.
struct TriangleReference {
  float lower[3];
  std::uint32_t primitive;
  float upper[3];
  std::uint32_t unused;
};

/// Nodes are in depth-first order; the left child of an inner one is the next.
struct BinaryNode {
  float lower[3];
  std::uint32_t first;  ///< of its references
  float upper[3];
  std::uint32_t count;  ///< of its references; 1: it is a leaf. A node with n has 2n - 1 nodes below and with it.
};

/// Triangles whose corners are so large, infinite or not a number are met by no ray. (Embree's bound.)
inline constexpr float kLargestCoordinate = 1.844e18f;

struct BinaryTree {
  Array<TriangleReference> references;
  Array<BinaryNode> nodes;  ///< none without triangles

  static std::uint32_t left(std::uint32_t node) { return node + 1; }
  std::uint32_t right(std::uint32_t node) const { return node + 2 * nodes[node + 1].count; }
};

/// References to all triangles that rays can meet.
Array<TriangleReference> triangle_references(const SceneTables& scene);

/// Down to single references. The tree does not depend on the number of threads, and has at most kBvhMostLevels levels.
BinaryTree build_binary_tree(Array<TriangleReference> references, int threads);

}  // namespace norrsken
