#include "formats/two_sides.h"

#include <utility>

#include "formats/pbrt/shapes.h"

namespace norrsken::pbrt {

std::vector<Geometry> two_sides(Context& context, const Geometry& geometry) {
  const Mesh& mesh = *geometry.mesh;
  const std::size_t floats = mesh.positions.size() + mesh.normals.size() + mesh.texcoords.size();
  context.memory.grow(2 * (sizeof(float) * floats + sizeof(std::uint32_t) * mesh.triangles.size()));
  std::vector<Geometry> sides;
  for (Mesh& moved : norrsken::two_sides(mesh)) {
    Geometry side = geometry;
    side.mesh = std::make_shared<const Mesh>(std::move(moved));
    side.node.set("mesh", side.mesh);
    sides.push_back(std::move(side));
  }
  return sides;
}

}  // namespace norrsken::pbrt
