// What a shape becomes.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "compile/analytic_shape.h"
#include "formats/mesh_data.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// A shape in world space. With `normals` the mesh is smooth, without it is flat.
struct ShapeGeometry {
  struct Sphere {
    glm::dvec3 center;
    double radius;
    bool flip_normals;
    std::uint32_t object_from_world = kNone;  ///< as in ShapeRecord
  };
  MeshData mesh;
  std::vector<Sphere> spheres;
  std::optional<AnalyticShape> analytic;
  bool of_shapes = false;  ///< made of other shapes, which the builder has already; all else is empty
};

}  // namespace norrsken
