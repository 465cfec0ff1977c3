// Rays through a bounding volume hierarchy of triangles: all of a wave, some of them under way at a time.
//
// A ray that is alone waits: for memory where the hierarchy is large, for its own last result where it is not. So some
// rays take one step each in turn, and what a ray needs next has been asked for when its turn comes again. A step has no
// branch but the one between node and block. Which rays share their turns changes nothing of what becomes of a ray.
//
// A node's bounds are met robustly: products and differences may round, so a ray counts as leaving a box a little later
// than computed (Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013, section 3).
#pragma once

#include "accel/bvh/cross_block.h"
#include "accel/bvh/waiting_children.h"

namespace norrsken::NORRSKEN_ISA {

/// How much later. Entry and exit have three roundings each, of 2^-24; and since a distance that is off by so much of
/// itself is a bound that is off by so much of its distance from the origin, the five in which the coordinates of
/// cross_block() differ from exact ones fit in as well. Bounds are wider by what its edges round (src/accel/bvh/layout.cpp).
inline constexpr float kLater = 1.0f + 0x1p-20f;

enum class Query { closest, occlusion };

/// Which children the ray meets before its end; `entry` is where.
NORRSKEN_INLINE std::uint32_t met_children(const BvhNode& node, const RayState& r, Octet& entry) {
  const float* bounds = &node.bounds[0][0][0];
  Octet near[3], far[3];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Octet origin(r.origin[k]), reciprocal(r.reciprocal[k]);
    near[k] = (load_octet(bounds + r.near_bounds[k]) - origin) * reciprocal;
    far[k] = (load_octet(bounds + (r.near_bounds[k] ^ kBvhWidth)) - origin) * reciprocal;
  }
  entry = max(max(near[0], near[1]), max(near[2], Octet(0.0f)));
  const Octet exit = min(min(far[0], far[1]), min(far[2], Octet(r.t)));
  return to_bits(entry <= exit * Octet(kLater));
}

/// Whether the ray has ended here.
template <Query query>
NORRSKEN_INLINE bool visit_block(const TriangleBlock& block, const RaySpan& rays, RayState& r) {
  const BlockCrossing c = cross_block(block, rays, r);
  if (c.crossed == 0) return false;
  const Octet t_max(r.t);
  if constexpr (query == Query::occlusion) {
    if ((c.crossed & to_bits((Octet(0.0f) < c.t) & (c.t < t_max))) == 0) return false;
    r.t = -__builtin_inff();
    return true;
  }
  std::uint32_t nearer = c.crossed & to_bits((Octet(0.0f) < c.t) & (c.t <= t_max));
  if (nearer == 0) return false;
  alignas(32) float t[kBvhWidth], determinant[kBvhWidth];
  store_octet(t, c.t);
  store_octet(determinant, c.determinant);
  const float before = r.t;
  for (; nearer != 0; nearer &= nearer - 1) {
    const int i = __builtin_ctz(nearer);
    const std::uint32_t primitive = block.primitive[i];
    // Of several at one distance the first primitive is hit, whichever comes first on the way.
    if (!(t[i] < r.t || (t[i] == r.t && primitive < (r.primitive_side & 0x7fffffffu)))) continue;
    const bool back = (determinant[i] < 0.0f) == (r.shear[2] > 0.0f);
    r.t = t[i];
    r.primitive_side = primitive | (back ? 0x80000000u : 0u);
  }
  if (r.t < before) drop_behind(r, r.t * kLater);
  return false;
}

/// Asks for all of the child's lines. The address is computed without a choice, of which compilers make a branch.
NORRSKEN_INLINE void prefetch(const CacheLine* lines, std::uint32_t child) {
  const CacheLine* line = lines + (child & ~kBvhLeaf);
  for (int i = 0; i < 4; ++i) __builtin_prefetch(line + i);
  __builtin_prefetch(line + 3 + (child >> 31));
}

/// So many that what one of them needs has come from memory while the others took their steps. Measured from 650 to a million
/// triangles (docs/performance.md): fewer lose, and so does it not to ask, even where all is in the cache.
inline constexpr std::uint32_t kUnderWay = 16;

template <Query query>
__attribute__((noinline)) inline void traverse(const BvhView& bvh, const RaySpan& rays) {
  if (bvh.root == kBvhNothing) return;
  RayState states[kUnderWay];
  RayState* active[kUnderWay];
  std::uint32_t count = 0;
  RaysToStart to_start(rays, bvh.root);
  while (count < kUnderWay && to_start.start_next(states[count])) active[count] = &states[count], ++count;
  while (count > 0) {
    for (std::uint32_t i = 0; i < count;) {
      RayState& r = *active[i];
      const CacheLine* line = bvh.lines + (r.current & ~kBvhLeaf);
      bool ended = false;
      if ((r.current & kBvhLeaf) == 0) {
        const BvhNode& node = *reinterpret_cast<const BvhNode*>(line);
        Octet entry;
        const std::uint32_t met = met_children(node, r, entry);
        if constexpr (query == Query::closest) {
          push_sorted(r, node, entry, met);
        } else {
          push_unsorted(r, node, met);
        }
      } else {
        ended = visit_block<query>(*reinterpret_cast<const TriangleBlock*>(line), rays, r);
      }
      r.current = r.child[--r.waiting];
      if (!ended && r.current != kBvhNothing) {
        prefetch(bvh.lines, r.current);
        ++i;
        continue;
      }
      rays.t[r.ray] = r.t;
      if (query == Query::closest && r.primitive_side != kBvhNothing) rays.primitive_side[r.ray] = r.primitive_side;
      if (to_start.start_next(r)) {
        ++i;
      } else {
        active[i] = active[--count];
      }
    }
  }
}

}  // namespace norrsken::NORRSKEN_ISA
