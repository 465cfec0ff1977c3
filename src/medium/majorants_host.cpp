#include "medium/majorants_host.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace norrsken {
namespace {

constexpr double kValuesPerCell = 8;
constexpr double kMostCells = 256;  ///< along an axis; kernels have ten bits for one

struct Box {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
  void extend(const glm::dvec3& p) { lower = glm::min(lower, p), upper = glm::max(upper, p); }
};

/// Which values of an axis an interval of local coordinates may look up.
struct Interval {
  std::int64_t first, count;
};

Interval values_of(double low, double high, std::int64_t size, VolumeWrap wrap) {
  // One more on each side for the interpolation, and for rounding.
  const double n = static_cast<double>(size);
  const double first = std::floor(low * n - 0.5 - 1e-3), last = std::floor(high * n - 0.5 + 1e-3) + 1;
  if (wrap != VolumeWrap::clamp && (first < 0 || last > n - 1)) return {0, size};
  const auto begin = static_cast<std::int64_t>(std::clamp(first, 0.0, n - 1)),
             end = static_cast<std::int64_t>(std::clamp(last, 0.0, n - 1));
  return {begin, end - begin + 1};
}

class LargestValue {
 public:
  LargestValue(const SceneTables& tables, const VolumeRecord& volume) : tables_(tables), volume_(volume) {}

  double in(const Box& local) const {
    if (volume_.size_x == 0) return std::max({volume_.value[0], volume_.value[1], volume_.value[2], 0.0f});
    const std::int64_t nx = static_cast<std::int64_t>(volume_.size_x), ny = static_cast<std::int64_t>(volume_.size_y),
                       nz = static_cast<std::int64_t>(volume_.size_z);
    const Interval x = values_of(local.lower.x, local.upper.x, nx, volume_.wrap),
                   y = values_of(local.lower.y, local.upper.y, ny, volume_.wrap),
                   z = values_of(local.lower.z, local.upper.z, nz, volume_.wrap);
    const std::size_t channels = volume_.channels, row = static_cast<std::size_t>(x.count) * channels;
    float largest = 0;
    for (std::int64_t k = z.first; k < z.first + z.count; ++k) {
      for (std::int64_t j = y.first; j < y.first + y.count; ++j) {
        const float* at =
            tables_.texels.data() + volume_.first + static_cast<std::size_t>((k * ny + j) * nx + x.first) * channels;
        for (std::size_t i = 0; i < row; ++i) largest = std::max(largest, at[i]);
      }
    }
    return double{largest};
  }

 private:
  const SceneTables& tables_;
  const VolumeRecord& volume_;
};

glm::dmat4 map_of(const float (&rows)[12]) {
  glm::dmat4 map(1);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) map[column][row] = double{rows[4 * row + column]};
  }
  return map;
}

/// Along each axis of the world about as many cells as the values there ask for.
glm::dvec3 cells_of(const VolumeRecord& volume, const glm::dmat4& local_from_world, const glm::dvec3& extent) {
  if (volume.size_x == 0) return glm::dvec3(1);
  const glm::dvec3 size(volume.size_x, volume.size_y, volume.size_z);
  glm::dvec3 cells;
  for (int axis = 0; axis < 3; ++axis) {
    double values = 0;
    for (int k = 0; k < 3; ++k) values = std::max(values, std::abs(local_from_world[axis][k]) * size[k]);
    cells[axis] = std::clamp(std::ceil(values * extent[axis] / kValuesPerCell), 1.0, kMostCells);
  }
  return cells;
}

}  // namespace

Volume add_volume(Media& media, VolumeRecord record, const glm::dmat4& world_from_local, double min, double max) {
  const glm::dmat4 local_from_world = glm::inverse(world_from_local);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column)
      record.local_from_world[4 * row + column] = static_cast<float>(local_from_world[column][row]);
  }
  Box box;
  for (int corner = 0; corner < 8; ++corner)
    box.extend(glm::dvec3(world_from_local * glm::dvec4(corner & 1, corner >> 1 & 1, corner >> 2 & 1, 1)));
  Array<VolumeRecord>& volumes = media.tables().volumes;
  volumes.push_back(record);
  return {static_cast<std::uint32_t>(volumes.size() - 1), min, max, box.lower, box.upper};
}

Volume add_constant(Media& media, const glm::dvec3& value, const glm::dmat4& world_from_local) {
  VolumeRecord record{};
  for (int c = 0; c < 3; ++c) record.value[c] = static_cast<float>(value[c]);
  record.channels = 3;
  return add_volume(media, record, world_from_local, std::min({value.r, value.g, value.b}),
                    std::max({value.r, value.g, value.b}));
}

MajorantSummary add_majorants(SceneTables& tables, const Volume& volume, double scale, MediumRecord& record) {
  const VolumeRecord values = tables.volumes[volume.index];
  const glm::dmat4 local_from_world = map_of(values.local_from_world);
  const glm::dvec3 extent = volume.upper - volume.lower, cells = cells_of(values, local_from_world, extent);
  for (int axis = 0; axis < 3; ++axis) {
    record.lower[axis] = static_cast<float>(volume.lower[axis]);
    record.upper[axis] = static_cast<float>(volume.upper[axis]);
  }
  record.cells_x = static_cast<float>(cells.x), record.cells_y = static_cast<float>(cells.y);
  record.cells_z = static_cast<float>(cells.z);
  record.majorants = static_cast<std::uint32_t>(tables.texels.size());
  const glm::dvec3 size = extent / cells;
  MajorantSummary summary;
  for (double z = 0; z < cells.z; ++z) {
    for (double y = 0; y < cells.y; ++y) {
      for (double x = 0; x < cells.x; ++x) {
        Box local;
        for (int corner = 0; corner < 8; ++corner) {
          // What rounding may take into a cell is its neighbour's, too.
          const glm::dvec3 far(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
          const glm::dvec3 at = glm::dvec3(x, y, z) + far + (far * 2.0 - 1.0) * 1e-3;
          local.extend(glm::dvec3(local_from_world * glm::dvec4(volume.lower + at * size, 1)));
        }
        // In float, scaled as kernels scale, and what rounding of the interpolation may add.
        const double majorant = LargestValue(tables, values).in(local)*scale * (1 + 1e-6);
        tables.texels.push_back(static_cast<float>(majorant));
        summary.mean += majorant;
        ++summary.count;
      }
    }
  }
  summary.mean /= summary.count;
  return summary;
}

}  // namespace norrsken
