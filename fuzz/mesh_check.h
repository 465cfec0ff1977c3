// What holds for every mesh that a reader gives back.
#pragma once

#include <algorithm>
#include <cmath>
#include <ranges>

#include "formats/mesh_readers.h"
#include "fuzz/fuzz.h"

namespace norrsken::fuzz {

inline bool all_finite(const auto& values) {
  return std::ranges::all_of(values, [](const auto& value) {
    return std::ranges::all_of(value, [](float component) { return std::isfinite(component); });
  });
}

inline void check_mesh(const MeshData& mesh) {
  const std::size_t vertices = mesh.positions.size();
  require(!mesh.triangles.empty() || vertices == 0, "a mesh has triangles or nothing at all");
  require(std::ranges::all_of(mesh.triangles, [&](const auto& t) { return std::ranges::max(t) < vertices; }),
          "triangles name vertices that there are");
  require(mesh.normals.empty() || mesh.normals.size() == vertices, "a normal for every vertex or none");
  require(mesh.texcoords.empty() || mesh.texcoords.size() == vertices, "texture coordinates for every vertex or none");
  require(all_finite(mesh.positions) && all_finite(mesh.normals) && all_finite(mesh.texcoords), "values are finite");
  for (const MeshAttribute& attribute : mesh.attributes) {
    const std::size_t places = attribute.per_face ? mesh.triangles.size() : vertices;
    require(attribute.values.size() == places * attribute.channels, "an attribute has a value for every place");
    require(std::ranges::all_of(attribute.values, [](float v) { return std::isfinite(v); }), "attributes are finite");
  }
}

/// A fuzz target's body: `read` makes a mesh of the bytes or complains.
inline int fuzz_mesh(const auto& read) {
  Diagnostics diagnostics;
  const auto mesh = read(diagnostics);
  check_complaints(mesh.has_value(), diagnostics);
  if (mesh) check_mesh(*mesh);
  return 0;
}

}  // namespace norrsken::fuzz
