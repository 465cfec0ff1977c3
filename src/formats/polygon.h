// Polygons with any number of corners, cut into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "base/memory.h"

namespace norrsken {

/// Cuts a face as it looks from the front of its best plane (Newell's normal), in which it may be concave, touch itself or
/// not be flat in space. One that crosses itself gets triangles somehow. The time is bounded, over all faces that one
/// cutter is given: what is too intricate for that stays a fan, and `too_intricate` is set.
///
/// Sources: Newell's normal: Sutherland, Sproull, Schumacker 1974, A Characterization of Ten Hidden-Surface Algorithms,
/// appendix; ears: Meisters 1975, Polygons Have Ears.
class PolygonCutter {
 public:
  using Point = std::array<float, 3>;
  using Triangle = std::array<std::uint32_t, 3>;

  /// Corners by their place in the polygon, always two triangles fewer than corners; those without an area among them.
  /// Empty if the fan around the first corner is right, as in every convex polygon. Valid until the next call.
  std::span<const Triangle> cut(std::span<const Point> corners);

  bool too_intricate = false;

 private:
  struct Flat {
    double x, y;
    bool operator==(const Flat&) const = default;
  };
  struct Corner {
    Flat at;
    std::uint32_t previous, next;
    bool is_left, blocks;  ///< not cut off yet; not convex, so that it may lie in somebody else's ear
  };
  /// What is good enough to be cut off, from the best to anything at all.
  enum Standard { kEar, kThinEar, kTouchedEar, kNothing, kConvex, kAny };

  void project(std::span<const Point> corners, glm::dvec3 normal);
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  bool is_convex(std::uint32_t i) const { return turn(corners_[i].previous, i, corners_[i].next) > 0; }
  void fill_grid();
  std::uint32_t column(double x) const;
  std::uint32_t row(double y) const;
  bool may_cut(std::uint32_t i, Standard standard);
  std::array<std::uint32_t, 2> columns_of(const std::array<Flat, 3>& triangle, std::uint32_t row) const;
  bool is_blocked(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool by_touch);
  bool clip();

  Array<Corner> corners_;
  Array<Triangle> triangles_;
  /// Blocking corners by cells of a grid over the polygon: those of cell i are blockers_[first_[i]] to [end_[i]].
  Array<std::uint32_t> blockers_, first_, end_;
  std::uint32_t columns_ = 1, rows_ = 1;  ///< of the grid
  Flat lower_{}, cells_per_unit_{};
  /// Corners and cells that may still be looked at: some for all, and more with every corner.
  std::int64_t work_left_ = std::int64_t{1} << 26;
};

}  // namespace norrsken
