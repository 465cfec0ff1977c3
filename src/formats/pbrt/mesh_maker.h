// Puts a mesh together in the world, counted in the memory budget.
#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "formats/pbrt/shapes.h"

namespace norrsken::pbrt {

class MeshMaker {
 public:
  /// `flip`: normals are given for the other side.
  MeshMaker(Context& context, const glm::dmat4& to_world, bool flip);

  /// For so many more; may throw MemoryExceeded.
  void reserve(std::size_t vertices, std::size_t triangles);
  /// In local coordinates. All vertices have a normal, or none has.
  std::uint32_t vertex(const glm::dvec3& position, const glm::dvec3* normal, const glm::dvec2* uv);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// A grid of a surface over the unit square.
  struct Point {
    glm::dvec3 position, normal;
  };
  void grid(int columns, int rows, const std::function<Point(const glm::dvec2& uv)>& surface);
  /// Turns every triangle around.
  void reverse_winding();

  /// The shape, flat where vertices have no normals; empty without triangles. Complains about vertices too far away.
  std::optional<Geometry> finish(const Parameters& p);

 private:
  Context& context_;
  glm::dmat4 to_world_;
  glm::dmat3 normals_to_world_;
  Mesh mesh_;
};

/// The area of each of a mesh's triangles.
double triangle_area(const Mesh& mesh, std::size_t triangle);

}  // namespace norrsken::pbrt
