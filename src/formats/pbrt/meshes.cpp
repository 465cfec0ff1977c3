// The shapes that are meshes already: trianglemesh, plymesh, bilinearmesh.
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "formats/mesh_readers.h"
#include "formats/pbrt/mesh_maker.h"

namespace norrsken::pbrt {
namespace {

/// Up to so many triangles get corners of their own where they need texture coordinates of their own.
constexpr std::size_t kMostApart = 100000;
constexpr int kPatchPieces = 16;  // along a side of a bilinear patch that is no parallelogram

glm::dvec3 vector_at(const Array<double>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// What trianglemesh and bilinearmesh are given.
struct Arrays {
  const Array<double>*positions = nullptr, *normals = nullptr, *uv = nullptr;
  Array<std::uint32_t> indices;
  std::size_t vertices = 0;
};

/// Values that there have to be as many of as of vertices: pbrt leaves out others.
const Array<double>* for_each_vertex(Context& context, Parameters& p, std::string_view type, std::string_view name,
                                     std::size_t per_element, std::size_t vertices) {
  const Array<double>* values = p.list(type, name, per_element);
  if (!values || values->size() == per_element * vertices) return values;
  context.diagnostics.warning(p.find(type, name)->place.location(),
                              fmt::format("'{}' of {} is left out: it is for {} vertices of {}", name, p.object(),
                                          values->size() / per_element, vertices),
                              "one for each of P");
  return nullptr;
}

/// Empty after a complaint. `corners` are those of a face.
std::optional<Arrays> read_arrays(Context& context, Parameters& p, std::size_t corners) {
  Arrays arrays;
  arrays.positions = p.list("point3", "P", 3);
  if (!arrays.positions) {
    if (!p.has("P")) p.error(nullptr, fmt::format("{} has no vertices", p.object()), R"("point3 P" [ x y z ... ])");
    return std::nullopt;
  }
  arrays.vertices = arrays.positions->size() / 3;
  arrays.normals = for_each_vertex(context, p, "normal", "N", 3, arrays.vertices);
  arrays.uv = for_each_vertex(context, p, "point2", "uv", 2, arrays.vertices);
  const Array<double>* given = p.list("integer", "indices", 1);
  const Parameter* at = p.find("integer", "indices");
  if (!given) {
    if (arrays.vertices != corners) {
      p.error(at, fmt::format("{} has {} vertices and no indices", p.object(), arrays.vertices),
              fmt::format("\"integer indices\", or {} vertices", corners));
      return std::nullopt;
    }
    for (std::uint32_t i = 0; i < corners; ++i) arrays.indices.push_back(i);
    return arrays;
  }
  std::size_t count = given->size();
  if (count % corners != 0) {
    context.diagnostics.warning(
        at->place.location(),
        fmt::format("{} has {} indices, the last {} of which are left out", p.object(), count, count % corners),
        fmt::format("a multiple of {}", corners));
    count -= count % corners;
  }
  arrays.indices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double index = (*given)[i];
    if (!(index >= 0 && index < static_cast<double>(arrays.vertices))) {
      p.error(at, fmt::format("{} has vertex {:g} of {}", p.object(), index, arrays.vertices),
              "vertices counted from 0");
      return std::nullopt;
    }
    arrays.indices.push_back(static_cast<std::uint32_t>(index));
  }
  return arrays;
}

glm::dvec2 uv_at(const Array<double>& values, std::size_t i) { return {values[2 * i], values[2 * i + 1]}; }

bool are_parallelograms(const Arrays& arrays) {
  for (std::size_t i = 0; i < arrays.indices.size(); i += 4) {
    glm::dvec3 corner[4];
    for (std::size_t k = 0; k < 4; ++k) corner[k] = vector_at(*arrays.positions, arrays.indices[i + k]);
    const glm::dvec3 twist = corner[0] + corner[3] - corner[1] - corner[2];
    if (!(glm::length(twist) <= 1e-6 * glm::length(corner[3] - corner[0]))) return false;
  }
  return true;
}

std::optional<Geometry> from_mesh_data(Context& context, const Parameters& p, const MeshData& data,
                                       const Placement& placement) {
  MeshMaker maker(context, placement.to_world, placement.reverse);
  maker.reserve(data.positions.size(), data.triangles.size());
  for (std::size_t i = 0; i < data.positions.size(); ++i) {
    const auto vector = [](const std::array<float, 3>& v) { return glm::dvec3(v[0], v[1], v[2]); };
    glm::dvec3 normal;
    glm::dvec2 uv;
    if (!data.normals.empty()) normal = vector(data.normals[i]);
    if (!data.texcoords.empty()) uv = {data.texcoords[i][0], data.texcoords[i][1]};
    maker.vertex(vector(data.positions[i]), data.normals.empty() ? nullptr : &normal,
                 data.texcoords.empty() ? nullptr : &uv);
  }
  for (const auto& t : data.triangles) maker.triangle(t[0], t[1], t[2]);
  if (placement.reverse != placement.is_mirrored()) maker.reverse_winding();
  auto geometry = maker.finish(p);
  if (geometry) geometry->triangles_per_primitive = 1;
  return geometry;
}

}  // namespace

std::optional<Geometry> make_triangle_mesh(Context& context, Parameters& p, const Placement& placement) {
  p.list("integer", "faceIndices", 1);
  if (p.list("vector3", "S", 3))
    context.tell(p.find("vector3", "S")->place, "tangents 'S' of meshes are not supported",
                 "those of the texture coordinates");
  const auto arrays = read_arrays(context, p, 3);
  if (!arrays) return std::nullopt;
  const std::size_t triangles = arrays->indices.size() / 3;
  MeshMaker maker(context, placement.to_world, placement.reverse);
  // Without any, pbrt gives the corners of each triangle these.
  const bool apart = !arrays->uv && placement.depends_on_uv && triangles <= kMostApart;
  const auto add = [&](std::size_t i, const glm::dvec2* uv) {
    const glm::dvec3 normal = arrays->normals ? vector_at(*arrays->normals, i) : glm::dvec3(0);
    return maker.vertex(vector_at(*arrays->positions, i), arrays->normals ? &normal : nullptr, uv);
  };
  if (apart) {
    static constexpr glm::dvec2 kCorners[3] = {{0, 0}, {1, 0}, {1, 1}};
    maker.reserve(3 * triangles, triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      std::uint32_t v[3];
      for (std::size_t k = 0; k < 3; ++k) v[k] = add(arrays->indices[3 * t + k], &kCorners[k]);
      maker.triangle(v[0], v[1], v[2]);
    }
  } else {
    maker.reserve(arrays->vertices, triangles);
    for (std::size_t i = 0; i < arrays->vertices; ++i) {
      const glm::dvec2 uv = arrays->uv ? uv_at(*arrays->uv, i) : glm::dvec2(0);
      add(i, arrays->uv ? &uv : nullptr);
    }
    for (std::size_t t = 0; t < triangles; ++t)
      maker.triangle(arrays->indices[3 * t], arrays->indices[3 * t + 1], arrays->indices[3 * t + 2]);
  }
  // The front of a triangle without normals is where it was before it was mirrored.
  if (placement.reverse != placement.is_mirrored()) maker.reverse_winding();
  auto geometry = maker.finish(p);
  if (geometry) geometry->triangles_per_primitive = 1;
  return geometry;
}

std::optional<Geometry> make_ply_mesh(Context& context, Parameters& p, const Placement& placement) {
  const Parameter* filename = p.find("string", "filename");
  if (const Parameter* displacement = p.find("texture", "displacement"))
    context.tell(displacement->place, "displacement of 'plymesh' is not supported", "the mesh as it is");
  p.number("edgelength", 1);
  if (!filename || !p.has_values(*filename, 1)) {
    if (!filename) p.error(nullptr, "shape 'plymesh' has no file", R"("string filename" "mesh.ply")");
    return std::nullopt;
  }
  const std::string path = context.find_file(*filename);
  if (path.empty()) return std::nullopt;
  std::string error;
  const auto contents = read_unpacked(context.files, path, error);
  if (!contents) {
    p.error(filename, fmt::format("cannot read the mesh {}: {}", quoted(path, 200), error), "a PLY file");
    return std::nullopt;
  }
  const auto data = read_ply(contents->bytes, path, context.diagnostics);
  if (!data) return std::nullopt;
  return from_mesh_data(context, p, *data, placement);
}

std::optional<Geometry> make_bilinear_mesh(Context& context, Parameters& p, const Placement& placement) {
  p.list("integer", "faceIndices", 1);
  p.text("emissionfilename", {});
  const auto arrays = read_arrays(context, p, 4);
  if (!arrays) return std::nullopt;
  MeshMaker maker(context, placement.to_world, placement.reverse);
  const int pieces = are_parallelograms(*arrays) ? 1 : kPatchPieces;
  for (std::size_t i = 0; i < arrays->indices.size(); i += 4) {
    const auto mix = [&](const auto& values, const glm::dvec2& at) {
      return glm::mix(glm::mix(values[0], values[1], at.x), glm::mix(values[2], values[3], at.x), at.y);
    };
    glm::dvec3 corners[4] = {}, normals[4] = {};
    glm::dvec2 uv[4] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t v = arrays->indices[i + k];
      corners[k] = vector_at(*arrays->positions, v);
      if (arrays->normals) normals[k] = vector_at(*arrays->normals, v);
      if (arrays->uv) uv[k] = uv_at(*arrays->uv, v);
    }
    const auto wide = static_cast<std::uint32_t>(pieces + 1);
    maker.reserve(std::size_t{wide} * wide, 2 * static_cast<std::size_t>(pieces * pieces));
    std::uint32_t first = 0;
    for (int y = 0; y <= pieces; ++y) {
      for (int x = 0; x <= pieces; ++x) {
        const glm::dvec2 at = glm::dvec2(x, y) / static_cast<double>(pieces);
        const glm::dvec3 du = glm::mix(corners[1] - corners[0], corners[3] - corners[2], at.y);
        const glm::dvec3 dv = glm::mix(corners[2] - corners[0], corners[3] - corners[1], at.x);
        const glm::dvec3 normal = arrays->normals ? mix(normals, at) : glm::cross(du, dv);
        const glm::dvec2 texcoord = mix(uv, at);
        const std::uint32_t v = maker.vertex(mix(corners, at), &normal, &texcoord);
        if (x == 0 && y == 0) first = v;
      }
    }
    for (std::uint32_t y = 0; y + 1 < wide; ++y) {
      for (std::uint32_t x = 0; x + 1 < wide; ++x) {
        const std::uint32_t a = first + y * wide + x;
        maker.triangle(a, a + 1, a + wide + 1);
        maker.triangle(a, a + wide + 1, a + wide);
      }
    }
  }
  auto geometry = maker.finish(p);
  if (geometry) geometry->triangles_per_primitive = 2 * static_cast<std::size_t>(pieces * pieces);
  return geometry;
}

}  // namespace norrsken::pbrt
