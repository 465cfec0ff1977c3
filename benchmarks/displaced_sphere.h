// Meshes to measure with: a displaced sphere that fits into the hexagon room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>

namespace norrsken {

struct SphereGrid {
  std::uint32_t rows, columns;  ///< of quads; vertices at the seam are there twice
  bool bare;                    ///< no normals, no texture coordinates

  std::uint32_t vertex_count() const { return (rows + 1) * (columns + 1); }
  std::uint32_t triangle_count() const { return 2 * rows * columns; }
};

/// About so many triangles, in quads about as wide as high at the equator.
SphereGrid sphere_grid(std::uint32_t triangles, bool bare);

void write_ply(const SphereGrid& grid, std::ostream& to);  ///< little-endian
void write_obj(const SphereGrid& grid, std::ostream& to);
void write_serialized(const SphereGrid& grid, std::ostream& to);  ///< Mitsuba's format, version 4

/// FOLDER/mesh.FORMAT ("ply", "obj" or "serialized"), whose path is returned, and FOLDER/scene.xml, the hexagon room with it. Throws
/// if that cannot be written.
std::filesystem::path write_scene(const SphereGrid& grid, const std::string& format,
                                  const std::filesystem::path& folder);

}  // namespace norrsken
