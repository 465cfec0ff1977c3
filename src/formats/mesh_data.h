// A triangle mesh as a file holds it, before a shape gives it a place in the scene.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace norrsken {

/// Indexed triangles. `normals` and `texcoords` are empty or as long as `positions`.
struct MeshData {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<float, 2>> texcoords;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the front
};

}  // namespace norrsken
