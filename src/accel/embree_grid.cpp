#include "accel/embree_grid.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "accel/embree_callbacks.h"
#include "accel/voxel.h"
#include "shape/sdfgrid.h"

namespace norrsken {
namespace {

using isa_host::Vec3f;

/// How much larger boxes are than the surface in them: rounding must not put it outside.
constexpr double kVoxelSlack = 1e-4;                ///< voxels
constexpr double kSlack = 8 * double{FLT_EPSILON};  ///< relative to coordinates

glm::dvec3 to_dvec(const Vec3f& v) { return {v.x.v, v.y.v, v.z.v}; }

/// The grid's table, read; its space has the voxel as the unit.
class Grid {
 public:
  explicit Grid(const ElementShape& shape) : shape_(shape) {
    for (std::uint32_t k = 0; k < 3; ++k) size_[k] = word(SdfGridTable::kSize + k);
  }

  Voxel voxel(std::uint32_t element) const {
    const std::uint32_t voxels_at = SdfGridTable::kValues + size_[0] * size_[1] * size_[2];
    const std::uint32_t number = word(voxels_at + element), x = number % size_[0], yz = number / size_[0];
    Voxel voxel{{x, yz % size_[1], yz / size_[1]}, {}};
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t corner = (i & 1) + size_[0] * (((i >> 1) & 1) + size_[1] * (i >> 2));
      voxel.values[i] = shape_.table[SdfGridTable::kValues + number + corner];
    }
    return voxel;
  }

  /// Exactly the stored map, to the grid's unit: nothing that is rounded on the way differs between voxels.
  glm::dmat4 grid_from_world() const {
    const float* m = shape_.record->place.local_from_world;
    glm::dmat4 map(1);
    for (int row = 0; row < 3; ++row) {
      const double voxels = size_[row] - 1.0;
      for (int column = 0; column < 4; ++column) map[column][row] = voxels * m[4 * row + column];
    }
    return map;
  }
  bool flips_normals() const { return shape_.record->flip_normals != 0; }

 private:
  std::uint32_t word(std::uint32_t k) const { return std::bit_cast<std::uint32_t>(shape_.table[k]); }

  const ElementShape& shape_;
  std::uint32_t size_[3];
};

struct Voxels {
  static void bounds_of(const void* shape, unsigned element, RTCBounds& bounds) {
    const Grid grid(*static_cast<const ElementShape*>(shape));
    const glm::dmat4 world_from_grid = glm::inverse(grid.grid_from_world());
    const Box box = surface_box(grid.voxel(element));
    const glm::dvec3 center = (box.lower + box.upper) / 2.0, half = (box.upper - box.lower) / 2.0 + kVoxelSlack;
    float lower[3], upper[3];
    for (int row = 0; row < 3; ++row) {
      double middle = world_from_grid[3][row], reach = 0, size = std::abs(middle);
      for (int column = 0; column < 3; ++column) {
        const double m = world_from_grid[column][row];
        middle += m * center[column];
        reach += std::abs(m) * half[column];
        size += std::abs(m) * (std::abs(center[column]) + half[column]);
      }
      reach += kSlack * size;
      lower[row] = static_cast<float>(middle - reach), upper[row] = static_cast<float>(middle + reach);
    }
    bounds.lower_x = lower[0], bounds.lower_y = lower[1], bounds.lower_z = lower[2];
    bounds.upper_x = upper[0], bounds.upper_y = upper[1], bounds.upper_z = upper[2];
  }

  static UserHit intersect(const void* shape, unsigned element, const Vec3f& o, const Vec3f& d, float t_max) {
    const Grid grid(*static_cast<const ElementShape*>(shape));
    const glm::dmat4 grid_from_world = grid.grid_from_world();
    const glm::dmat3 linear(grid_from_world);
    const glm::dvec3 origin = grid_from_world * glm::dvec4(to_dvec(o), 1), direction = linear * to_dvec(d);
    const std::optional<VoxelHit> hit = cross_voxel(grid.voxel(element), origin, direction, t_max);
    if (!hit) return {};
    const glm::dvec3 outwards = glm::transpose(linear) * hit->gradient * (grid.flips_normals() ? -1.0 : 1.0);
    // Only its direction counts: in floats its length may be nothing.
    const glm::dvec3 n =
        outwards / std::max({std::abs(outwards.x), std::abs(outwards.y), std::abs(outwards.z), DBL_MIN});
    return {hit->t, {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}};
  }
};

}  // namespace

RTCGeometry make_embree_grid(RTCDevice device, const ElementShape& shape) {
  return make_user_geometry<Voxels>(device, &shape, shape.record->element_count);
}

}  // namespace norrsken
