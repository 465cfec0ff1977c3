// A triangle mesh as a file holds it, before a shape gives it a place in the scene.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/memory.h"

namespace norrsken {

/// Values that a mesh has beside its geometry, for textures to look up by name.
struct MeshAttribute {
  std::string name;            ///< with "vertex_" or "face_" in front: "vertex_color"
  std::uint32_t channels = 1;  ///< 1 or 3
  bool per_face = false;       ///< a value for each triangle; otherwise one for each vertex
  Array<float> values;         ///< `channels` for each
};

/// Indexed triangles. `normals` and `texcoords` are empty or as long as `positions`.
struct MeshData {
  Array<std::array<float, 3>> positions;
  Array<std::array<float, 3>> normals;
  Array<std::array<float, 2>> texcoords;
  Array<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the front
  std::vector<MeshAttribute> attributes;
  /// The triangles whose second and third corner have changed places since they were read; empty: none.
  std::vector<bool> rewound;
  bool face_normals = false;  ///< the file wants its triangles flat
};

}  // namespace norrsken
