// Primitives of glTF's meshes as triangles, with morph targets and skins applied.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

#include "formats/gltf/materials.h"

namespace norrsken::gltf {

/// Triangles of one surface.
struct Part {
  std::shared_ptr<const Mesh> mesh;
  Surface surface;
  bool is_flat = false;  ///< there are no normals
};

/// How a mesh is bent before it is placed.
struct Deformation {
  std::vector<double> weights = {};     ///< of morph targets
  std::vector<glm::dmat4> joints = {};  ///< to the world; empty: no skin
};

/// What is left of a mesh's primitives; points and lines are told of.
std::vector<Part> make_parts(Asset& asset, Materials& materials, const Json& mesh, const Deformation& deformation);

}  // namespace norrsken::gltf
