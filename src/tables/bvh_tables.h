// A bounding volume hierarchy of triangles whose nodes have up to eight children, as the kernels walk it.
//
// Nodes and blocks of triangles stand in one array of cache lines; a child is the number of its first line and a bit that
// tells a block from a node, so that nothing has to be picked before memory is asked for.
#pragma once

#include <cstddef>
#include <cstdint>

namespace norrsken {

inline constexpr std::uint32_t kBvhWidth = 8;

struct alignas(64) CacheLine {
  std::byte bytes[64];
};

/// Bit 31 of a child: it is a TriangleBlock. Without it, a BvhNode.
inline constexpr std::uint32_t kBvhLeaf = 0x80000000u;
/// What no child's word is.
inline constexpr std::uint32_t kBvhNothing = 0xffffffffu;

/// Children that are not there have bounds that no ray meets.
struct alignas(64) BvhNode {
  float bounds[3][2][kBvhWidth];  ///< by axis: lower, upper
  std::uint32_t child[kBvhWidth];
  std::uint32_t unused[kBvhWidth];
};

/// Triangles in order of their primitives; those that are not there are points, which no ray meets.
struct alignas(64) TriangleBlock {
  float corners[3][3][kBvhWidth];  ///< by axis, by corner
  std::uint32_t primitive[kBvhWidth];
};

static_assert(sizeof(BvhNode) == 4 * sizeof(CacheLine) && sizeof(TriangleBlock) == 5 * sizeof(CacheLine));

/// How many levels of nodes there are at most (src/accel/bvh/binary_tree.h sees to it), and so what a ray may have to
/// come back to.
inline constexpr std::uint32_t kBvhMostLevels = 80;

/// Borrowed.
struct BvhView {
  const CacheLine* lines = nullptr;
  std::uint32_t root = kBvhNothing;
};

}  // namespace norrsken
