// The description as the library works with it: the public one, with vectors and matrices to calculate with.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "norrsken/description.h"

namespace norrsken {

/// Coordinates and matrix elements beyond this are refused: their squares must fit a float.
inline constexpr double kMaxCoordinate = 1e12;

inline glm::dvec3 to_glm(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
inline std::array<double, 3> to_array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Column-vector convention: world = matrix * local.
inline glm::dmat4 to_glm(const Property::Transform& transform) {
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      matrix[column][row] = transform.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }
  return matrix;
}
inline Property::Transform to_transform(const glm::dmat4& matrix) {
  Property::Transform transform;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      transform.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = matrix[column][row];
  }
  return transform;
}

/// "bsdf 'diffuse'"; the scene has no plugin.
std::string name_of(const Node& node);

}  // namespace norrsken
