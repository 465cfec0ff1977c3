// A shape with a formula of its own, in its place: what a disk's or a cylinder's host file hands to the builder.
#pragma once

#include <glm/mat4x4.hpp>

#include "tables/scene_tables.h"

namespace norrsken {

/// src/shape/NAME.h has the shape in its local space.
struct AnalyticShape {
  AnalyticKind kind;
  glm::dmat4 world_from_local;  ///< uniform points of the local shape are uniform in the world too
  double area;                  ///< in the world
  bool flip_normals;  ///< the local normal, taken to the world through the inverse transpose, is turned around
};

}  // namespace norrsken
