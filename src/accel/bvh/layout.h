// From the binary tree to the wide one that rays walk.
// Which nodes of the binary tree become children, and which of them blocks of triangles, is decided by the least cost
// that the surface area heuristic expects, for the whole tree: by dynamic programming, as Ylitie, Karras, Laine,
// "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017, section 3.1.
#pragma once

#include "accel/bvh/binary_tree.h"
#include "tables/bvh_tables.h"

namespace norrsken {

/// The hierarchy, with what its view borrows.
struct Bvh {
  Array<CacheLine> lines;
  std::uint32_t root = kBvhNothing;

  BvhView view() const { return {lines.data(), root}; }
};

/// Of the triangles of a scene.
Bvh build_bvh(const SceneTables& scene, int threads);

}  // namespace norrsken
