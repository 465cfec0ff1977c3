// A walk through the cells of a heterogeneous medium, each with the largest extinction in it: from one tentative collision
// to the next, with the random numbers of a counter.
//
// Source: Woodcock et al., "Techniques used in the GEM code for Monte Carlo neutronics calculations", 1965; the walk as
// Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987.
#pragma once

#include "medium/flakes.h"
#include "sampler/hash.h"
#include "wave/media.h"

namespace norrsken::NORRSKEN_ISA {

/// Where a ray is on its walk.
struct Walk {
  Float t;      ///< distance
  Float depth;  ///< optical, by the majorant, left to the next collision
  UInt cell;    ///< kNone before it has met the medium
  UInt drawn;   ///< random numbers
};

/// The random numbers of a walk are addressed by a word for all of it, and counted.
NORRSKEN_INLINE Float draw(UInt key, Walk& walk, Mask active) {
  walk.drawn = select(active, walk.drawn + 1u, walk.drawn);
  return to_unit(hash(key, walk.drawn));
}

/// Ten bits for each axis.
NORRSKEN_INLINE UInt packed_cell(const Vec3f& c) {
  return to_uint(c.x) | shift_left<10>(to_uint(c.y)) | shift_left<20>(to_uint(c.z));
}
NORRSKEN_INLINE Vec3f unpacked_cell(UInt cell) {
  return {to_float(cell & 1023u), to_float(shift_right<10>(cell) & 1023u), to_float(shift_right<20>(cell) & 1023u)};
}

/// The majorants of one medium, in lanes, and a ray in them.
struct MajorantGrid {
  Vec3f lower, upper, cells, size;  ///< size of a cell
  UInt first;
  Vec3f origin, direction, inverse;

  NORRSKEN_INLINE MajorantGrid(const SceneView& scene, UInt medium, const Vec3f& o, const Vec3f& d, Mask active)
      : origin(o), direction(d) {
    lower = gather_medium(scene, &MediumRecord::lower, medium, active);
    upper = gather_medium(scene, &MediumRecord::upper, medium, active);
    cells = {gather_medium(scene, &MediumRecord::cells_x, medium, active),
             gather_medium(scene, &MediumRecord::cells_y, medium, active),
             gather_medium(scene, &MediumRecord::cells_z, medium, active)};
    first = gather_medium(scene, &MediumRecord::majorants, medium, active);
    size = {(upper.x - lower.x) / cells.x, (upper.y - lower.y) / cells.y, (upper.z - lower.z) / cells.z};
    inverse = {1.0f / d.x, 1.0f / d.y, 1.0f / d.z};
  }

  struct Span {
    Float begin, end;
  };
  /// What of the ray is in the box.
  NORRSKEN_INLINE Span span() const {
    Span s{0.0f, kInfinity};
    const auto narrow = [&](Float o, Float inv, Float low, Float high) {
      const Float a = (low - o) * inv, b = (high - o) * inv;
      // Along an axis where the ray does not move it is within or it is not; there the quotients may be NaN.
      const Mask still = !(abs(inv) < kInfinity);
      const Mask within = (o >= low) & (o <= high);
      s.begin = max(s.begin, select(still, select(within, Float(0.0f), Float(kInfinity)), min(a, b)));
      s.end = min(s.end, select(still, kInfinity, max(a, b)));
    };
    narrow(origin.x, inverse.x, lower.x, upper.x);
    narrow(origin.y, inverse.y, lower.y, upper.y);
    narrow(origin.z, inverse.z, lower.z, upper.z);
    return s;
  }
  NORRSKEN_INLINE Vec3f cell_at(Float t) const {
    const Vec3f p = fma(direction, t, origin);
    const auto of_axis = [](Float x, Float low, Float cell, Float n) {
      return min(max(floor((x - low) / cell), 0.0f), n - 1.0f);
    };
    return {of_axis(p.x, lower.x, size.x, cells.x), of_axis(p.y, lower.y, size.y, cells.y),
            of_axis(p.z, lower.z, size.z, cells.z)};
  }
  NORRSKEN_INLINE Float majorant(const SceneView& scene, const Vec3f& cell, Mask active) const {
    const Float index = fma(fma(cell.z, cells.y, cell.y), cells.x, cell.x);
    return gather(scene.texels, first + to_uint(index), active);
  }
};

/// What becomes of a walk in one step.
struct Step {
  Mask collided;  ///< `walk.t` is there
  Mask ended;     ///< at `t_end`, or behind the medium
  Float majorant;
};

/// To the next collision or into the next cell, whichever comes first.
NORRSKEN_INLINE Step take_step(const SceneView& scene, const MajorantGrid& grid, Float t_end, UInt key, Walk& walk,
                               Mask active) {
  const Mask fresh = active & (walk.cell == kNone);
  if (any(fresh)) {
    const MajorantGrid::Span span = grid.span();
    const Mask meets = (span.begin < span.end) & (span.begin < t_end);
    walk.t = select(fresh, select(meets, max(span.begin, walk.t), kInfinity), walk.t);
    const Vec3f at = grid.cell_at(zero_unless(meets, walk.t));
    walk.cell = select(fresh, packed_cell(at), walk.cell);
  }
  const Mask inside = active & (walk.t < t_end);
  Vec3f cell = unpacked_cell(walk.cell);
  const Float majorant = grid.majorant(scene, cell, inside);
  const auto exit = [](Float c, Float low, Float size, Float o, Float d, Float inv) {
    const Float wall = fma(c + select(d > 0.0f, Float(1.0f), Float(0.0f)), size, low);
    return select(abs(inv) < kInfinity, (wall - o) * inv, kInfinity);
  };
  const Float ex = exit(cell.x, grid.lower.x, grid.size.x, grid.origin.x, grid.direction.x, grid.inverse.x);
  const Float ey = exit(cell.y, grid.lower.y, grid.size.y, grid.origin.y, grid.direction.y, grid.inverse.y);
  const Float ez = exit(cell.z, grid.lower.z, grid.size.z, grid.origin.z, grid.direction.z, grid.inverse.z);
  const Float out = max(min(ex, min(ey, ez)), walk.t), until = min(out, t_end);

  const Float there = majorant * (until - walk.t);
  const Mask collided = inside & (walk.depth < there);
  const Mask moves_on = inside & !collided;
  walk.t = select(collided, min(walk.t + walk.depth / majorant, until), select(moves_on, until, walk.t));
  walk.depth = select(moves_on, walk.depth - there, walk.depth);
  if (any(collided)) walk.depth = select(collided, collision_depth(draw(key, walk, collided)), walk.depth);

  const Mask along_x = moves_on & (ex <= ey) & (ex <= ez), along_y = moves_on & !along_x & (ey <= ez);
  const Mask along_z = moves_on & !along_x & !along_y;
  const auto next = [](Mask m, Float c, Float d) {
    return select(m, c + select(d > 0.0f, Float(1.0f), Float(-1.0f)), c);
  };
  cell = {next(along_x, cell.x, grid.direction.x), next(along_y, cell.y, grid.direction.y),
          next(along_z, cell.z, grid.direction.z)};
  const Mask within = (cell.x >= 0.0f) & (cell.y >= 0.0f) & (cell.z >= 0.0f) & (cell.x < grid.cells.x) &
                      (cell.y < grid.cells.y) & (cell.z < grid.cells.z);
  const Mask ended = active & ((!inside) | (moves_on & ((until >= t_end) | !within)));
  walk.cell = select(moves_on & within, packed_cell(cell), walk.cell);
  return {collided, ended, majorant};
}

/// The extinction of a heterogeneous medium there, at most its majorant.
NORRSKEN_INLINE Color extinction_at(const SceneView& scene, UInt medium, const Vec3f& position, const Vec3f& direction,
                                    Float majorant, Mask active) {
  const UInt volume = gather_medium(scene, &MediumRecord::sigma_volume, medium, active);
  const Color scale = gather_medium_color(scene, &MediumRecord::sigma_t, medium, active);
  Color sigma = evaluate_volume(scene, volume, copied(position), active) * scale;
  const UInt flakes = gather_medium(scene, &MediumRecord::flakes_volume, medium, active);
  const Mask oriented = active & (flakes != kNone);
  if (any(oriented)) {
    const Float area = projected_area(flakes_at(scene, flakes, copied(position), oriented), direction);
    sigma = select(oriented, sigma * area, sigma);
  }
  const auto bounded = [&](Float s) { return min(max(s, 0.0f), majorant); };
  return {bounded(sigma.r), bounded(sigma.g), bounded(sigma.b)};
}

}  // namespace norrsken::NORRSKEN_ISA
