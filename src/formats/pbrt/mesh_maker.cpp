#include "formats/pbrt/mesh_maker.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace norrsken::pbrt {
namespace {

glm::dvec3 position(const Mesh& mesh, std::uint32_t vertex) {
  const float* p = &mesh.positions[3 * std::size_t{vertex}];
  return {p[0], p[1], p[2]};
}

}  // namespace

double triangle_area(const Mesh& mesh, std::size_t triangle) {
  const std::uint32_t* v = &mesh.triangles[3 * triangle];
  const glm::dvec3 a = position(mesh, v[0]);
  return 0.5 * glm::length(glm::cross(position(mesh, v[1]) - a, position(mesh, v[2]) - a));
}

MeshMaker::MeshMaker(Context& context, const glm::dmat4& to_world, bool flip)
    : context_(context),
      to_world_(to_world),
      normals_to_world_((flip ? -1.0 : 1.0) * glm::transpose(glm::inverse(glm::dmat3(to_world)))) {}

void MeshMaker::reserve(std::size_t vertices, std::size_t triangles) {
  context_.memory.grow(sizeof(float) * 8 * vertices + sizeof(std::uint32_t) * 3 * triangles);
  mesh_.positions.reserve(mesh_.positions.size() + 3 * vertices);
  mesh_.triangles.reserve(mesh_.triangles.size() + 3 * triangles);
}

std::uint32_t MeshMaker::vertex(const glm::dvec3& position, const glm::dvec3* normal, const glm::dvec2* uv) {
  const auto number = static_cast<std::uint32_t>(mesh_.positions.size() / 3);
  const glm::dvec3 moved = to_world_ * glm::dvec4(position, 1);
  for (int i = 0; i < 3; ++i) mesh_.positions.push_back(static_cast<float>(moved[i]));
  if (normal) {
    const glm::dvec3 turned = normals_to_world_ * *normal;
    const double length = glm::length(turned);
    for (int i = 0; i < 3; ++i) mesh_.normals.push_back(static_cast<float>(length > 0 ? turned[i] / length : 0));
  }
  if (uv) {
    mesh_.texcoords.push_back(static_cast<float>(uv->x));
    mesh_.texcoords.push_back(static_cast<float>(uv->y));
  }
  return number;
}

void MeshMaker::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  for (const std::uint32_t v : {a, b, c}) mesh_.triangles.push_back(v);
}

void MeshMaker::grid(int columns, int rows, const std::function<Point(const glm::dvec2& uv)>& surface) {
  const auto wide = static_cast<std::uint32_t>(columns), high = static_cast<std::uint32_t>(rows);
  reserve(std::size_t{wide + 1} * (high + 1), 2 * std::size_t{wide} * high);
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size() / 3);
  for (std::uint32_t y = 0; y <= high; ++y) {
    for (std::uint32_t x = 0; x <= wide; ++x) {
      const glm::dvec2 uv(static_cast<double>(x) / wide, static_cast<double>(y) / high);
      const Point point = surface(uv);
      vertex(point.position, &point.normal, &uv);
    }
  }
  // Where a side of the square is one point there is a triangle less.
  const auto add = [this](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (position(mesh_, a) != position(mesh_, b) && position(mesh_, b) != position(mesh_, c) &&
        position(mesh_, c) != position(mesh_, a))
      triangle(a, b, c);
  };
  for (std::uint32_t y = 0; y < high; ++y) {
    for (std::uint32_t x = 0; x < wide; ++x) {
      const std::uint32_t a = first + y * (wide + 1) + x, b = a + wide + 1;
      add(a, a + 1, b + 1);
      add(a, b + 1, b);
    }
  }
}

void MeshMaker::reverse_winding() {
  for (std::size_t i = 0; i + 2 < mesh_.triangles.size(); i += 3)
    std::swap(mesh_.triangles[i + 1], mesh_.triangles[i + 2]);
}

std::optional<Geometry> MeshMaker::finish(const Parameters& p) {
  for (const float coordinate : mesh_.positions) {
    if (std::abs(static_cast<double>(coordinate)) <= kMaxCoordinate) continue;
    context_.diagnostics.error(p.place().location(), fmt::format("a vertex of {} is at {:g}", p.object(), coordinate),
                               fmt::format("coordinates from {:g} to {:g}", -kMaxCoordinate, kMaxCoordinate));
    return std::nullopt;
  }
  if (mesh_.triangles.empty()) return std::nullopt;
  Geometry geometry{.node = make_node("shape", "mesh", p.place())};
  for (std::size_t i = 0; i < mesh_.triangles.size() / 3; ++i) geometry.area += triangle_area(mesh_, i);
  if (mesh_.normals.empty()) give(geometry.node, "face_normals", true, p.place());
  geometry.mesh = std::make_shared<const Mesh>(std::move(mesh_));
  give(geometry.node, "mesh", geometry.mesh, p.place());
  return geometry;
}

}  // namespace norrsken::pbrt
