#include "formats/two_sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace norrsken {
namespace {

constexpr double kApart = 1e-5;  // of the largest coordinate: far enough for rays to tell which comes first

glm::dvec3 vector_at(const FloatArray& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// Where each vertex moves to come off the surface: the mean of its triangles' normals.
std::vector<glm::dvec3> directions_off(const Mesh& mesh) {
  std::vector<glm::dvec3> directions(mesh.positions.size() / 3, glm::dvec3(0));
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::uint32_t* v = &mesh.triangles[i];
    const glm::dvec3 a = vector_at(mesh.positions, v[0]);
    glm::dvec3 normal = glm::cross(vector_at(mesh.positions, v[1]) - a, vector_at(mesh.positions, v[2]) - a);
    if (!mesh.normals.empty() && glm::dot(normal, vector_at(mesh.normals, v[0])) < 0) normal = -normal;
    for (std::size_t k = 0; k < 3; ++k) directions[v[k]] += normal;
  }
  for (glm::dvec3& direction : directions) {
    const double length = glm::length(direction);
    if (length > 0) direction /= length;
  }
  return directions;
}

}  // namespace

std::array<Mesh, 2> two_sides(const Mesh& mesh) {
  const std::vector<glm::dvec3> directions = directions_off(mesh);
  float size = 0;
  for (const float coordinate : mesh.positions) size = std::max(size, std::abs(coordinate));
  std::array<Mesh, 2> sides{mesh, mesh};
  for (const bool is_back : {false, true}) {
    Mesh& side = sides[is_back ? 1 : 0];
    const double offset = (is_back ? -1 : 1) * kApart * double{size};
    for (std::size_t i = 0; i < side.positions.size(); ++i)
      side.positions[i] += static_cast<float>(offset * directions[i / 3][static_cast<int>(i % 3)]);
    if (!is_back) continue;
    for (std::size_t i = 0; i < side.triangles.size(); i += 3) std::swap(side.triangles[i + 1], side.triangles[i + 2]);
    for (float& component : side.normals) component = -component;
  }
  return sides;
}

}  // namespace norrsken
