#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "formats/pbrt/shapes.h"

namespace norrsken::pbrt {
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

std::vector<Geometry> two_sides(Context& context, const Geometry& geometry) {
  const Mesh& mesh = *geometry.mesh;
  const std::size_t floats = mesh.positions.size() + mesh.normals.size() + mesh.texcoords.size();
  context.memory.grow(2 * (sizeof(float) * floats + sizeof(std::uint32_t) * mesh.triangles.size()));
  const std::vector<glm::dvec3> directions = directions_off(mesh);
  float size = 0;
  for (const float coordinate : mesh.positions) size = std::max(size, std::abs(coordinate));
  std::vector<Geometry> sides;
  for (const double sign : {1.0, -1.0}) {
    Mesh moved = mesh;
    for (std::size_t i = 0; i < moved.positions.size(); ++i)
      moved.positions[i] +=
          static_cast<float>(sign * kApart * double{size} * directions[i / 3][static_cast<int>(i % 3)]);
    if (sign < 0) {
      for (std::size_t i = 0; i < moved.triangles.size(); i += 3)
        std::swap(moved.triangles[i + 1], moved.triangles[i + 2]);
      for (float& component : moved.normals) component = -component;
    }
    Geometry side = geometry;
    side.mesh = std::make_shared<const Mesh>(std::move(moved));
    side.node.set("mesh", side.mesh);
    sides.push_back(std::move(side));
  }
  return sides;
}

}  // namespace norrsken::pbrt
