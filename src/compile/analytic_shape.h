// A shape with a formula of its own, in its place: what a disk's or a cylinder's host file hands to the builder.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "tables/scene_tables.h"

namespace norrsken {

/// src/shape/NAME.h has the shape in its local space.
struct AnalyticShape {
  AnalyticKind kind;
  glm::dmat4 world_from_local;  ///< uniform points of the local shape are uniform in the world too
  double area;                  ///< in the world
  bool flip_normals;  ///< the local normal, taken to the world through the inverse transpose, is turned around
  glm::dvec3 lower{-1, -1, 0}, upper{1, 1, 1};  ///< local bounds
  Array<float> table = {};                      ///< what the kernels read of a shape made of elements
  std::uint32_t element_count = 1;              ///< of such a shape
  /// The elements are primitives of their own: a hit tells which one. Otherwise the shape is one primitive.
  bool elements_are_primitives = false;
};

}  // namespace norrsken
