// rectangle: the square [-1, 1] x [-1, 1] of the xy plane, facing +z.
//
// Two triangles; texture coordinates run from (0, 0) at (-1, -1) to (1, 1) at (1, 1). The normal is that of Mitsuba:
// +z taken through the inverse transpose of `to_world`, so a mirroring placement does not turn it around.
#include <glm/matrix.hpp>

#include "shape/mesh_host.h"

namespace norrsken {
namespace {

constexpr TransformParameter kToWorld{.name = "to_world", .text = "", .flat = Flat::yes};
constexpr BooleanParameter kFlipNormals{.name = "flip_normals", .text = "face -z instead"};

}  // namespace

std::optional<ShapeGeometry> compile_shape_rectangle(Parameters& p, Shapes& shapes) {
  const glm::dmat4 to_world = p.read(kToWorld);
  const bool flip_normals = p.read(kFlipNormals);
  shapes.describe(p.node(), "2 triangles");

  ShapeGeometry geometry;
  geometry.mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  geometry.mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  geometry.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const bool mirrored = glm::determinant(glm::dmat3(to_world)) < 0;
  if (mirrored != flip_normals) reverse_winding(geometry.mesh);
  if (!place_mesh(geometry.mesh, to_world, p)) return std::nullopt;
  return geometry;
}

}  // namespace norrsken
