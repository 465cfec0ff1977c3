// cube: from (-1, -1, -1) to (1, 1, 1), facing outwards.
//
// Two triangles a face; each face has the texture coordinates of the whole unit square, turned as Mitsuba turns them. A
// mirroring placement does not turn it inside out, as in Mitsuba.
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "shape/mesh_host.h"

namespace norrsken {
namespace {

constexpr TransformParameter kToWorld{.name = "to_world", .text = "", .flat = Flat::yes};
constexpr BooleanParameter kFlipNormals{.name = "flip_normals", .text = "face inwards"};
constexpr BooleanParameter kFaceNormals{.name = "face_normals", .text = "without effect, as the faces are flat"};

/// The directions in which u and v grow on a face; it looks along v x u.
struct Face {
  glm::dvec3 u, v;
};
constexpr glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);
constexpr Face kFaces[] = {{kZ, kX}, {-kX, -kZ}, {kY, -kZ}, {kY, kX}, {kY, kZ}, {-kY, kX}};

MeshData make_cube() {
  MeshData mesh;
  for (const Face& face : kFaces) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::dvec3 normal = glm::cross(face.v, face.u);
    for (const auto& [u, v] : {std::array{0.f, 1.f}, {1.f, 1.f}, {1.f, 0.f}, {0.f, 0.f}}) {
      const glm::vec3 p = normal + double(2 * u - 1) * face.u + double(2 * v - 1) * face.v;
      mesh.positions.push_back({p.x, p.y, p.z});
      mesh.texcoords.push_back({u, v});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first + 3, first, first + 2});
  }
  return mesh;
}

}  // namespace

std::optional<ShapeGeometry> compile_shape_cube(Parameters& p, Shapes& shapes) {
  const glm::dmat4 to_world = p.read(kToWorld);
  const bool flip_normals = p.read(kFlipNormals);
  p.read(kFaceNormals);
  shapes.describe(p.node(), "12 triangles");

  ShapeGeometry geometry;
  geometry.mesh = make_cube();
  const bool mirrored = glm::determinant(glm::dmat3(to_world)) < 0;
  if (mirrored != flip_normals) reverse_winding(geometry.mesh);
  if (!place_mesh(geometry.mesh, to_world, p)) return std::nullopt;
  return geometry;
}

}  // namespace norrsken
