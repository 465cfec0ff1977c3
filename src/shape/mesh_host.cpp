#include "shape/mesh_host.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <span>

#include "math/special.h"
#include "shape/shape_file_host.h"

namespace norrsken {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr FileParameter kFilename{.name = "filename"};
constexpr TransformParameter kToWorld{
    .name = "to_world", .text = "vertex normals go through its inverse transpose", .flat = Flat::yes};
constexpr BooleanParameter kFaceNormals{.name = "face_normals", .text = "shade flat, whatever normals there are"};
constexpr BooleanParameter kFlipNormals{.name = "flip_normals", .text = "turn the surface inside out"};

glm::dvec3 to_dvec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

std::array<float, 3> to_float(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Normal of a triangle, as long as twice its area.
glm::dvec3 area_normal(const MeshData& mesh, const Triangle& t) {
  const glm::dvec3 a = to_dvec(mesh.positions[t[0]]);
  return glm::cross(to_dvec(mesh.positions[t[1]]) - a, to_dvec(mesh.positions[t[2]]) - a);
}

glm::dvec3 normalized_or_zero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

/// Vertices whose normal came out as zero (none in the file, or faces that cancel each other) take that of a face.
void fill_missing_normals(MeshData& mesh) {
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t vertex : t) {
      if (to_dvec(mesh.normals[vertex]) == glm::dvec3(0)) {
        mesh.normals[vertex] = to_float(glm::normalize(area_normal(mesh, t)));
      }
    }
  }
}

/// Texture coordinates that a mesh does not have go by the order in which the file names a triangle's corners.
void rewind_triangle(MeshData& mesh, std::size_t i) {
  std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  if (!mesh.texcoords.empty()) return;
  mesh.rewound.resize(mesh.triangles.size());
  mesh.rewound[i].flip();
}

void wind_as_normals_say(MeshData& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const glm::dvec3 sum = to_dvec(mesh.normals[t[0]]) + to_dvec(mesh.normals[t[1]]) + to_dvec(mesh.normals[t[2]]);
    if (glm::dot(sum, area_normal(mesh, t)) < 0) rewind_triangle(mesh, i);
  }
}

void normalize_normals(MeshData& mesh, const glm::dmat3& normal_to_world) {
  for (auto& normal : mesh.normals) normal = to_float(normalized_or_zero(normal_to_world * to_dvec(normal)));
}

bool move_to_world(MeshData& mesh, const glm::dmat4& to_world, Parameters& p) {
  if (to_world == glm::dmat4(1)) {
    normalize_normals(mesh, glm::dmat3(1));
    return true;
  }
  for (auto& position : mesh.positions) {
    const glm::dvec3 moved = to_world * glm::dvec4(to_dvec(position), 1);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(moved[axis]) <= kMaxCoordinate) continue;
      p.error(kToWorld.name, fmt::format("a vertex is at ({:.6g}, {:.6g}, {:.6g})", moved.x, moved.y, moved.z),
              fmt::format("coordinates from {:g} to {:g}", -kMaxCoordinate, kMaxCoordinate));
      return false;
    }
    position = to_float(moved);
  }
  // A placement that flattens has no inverse; up to their length and sign, the cofactors are what it tends to.
  const glm::dmat3 linear(to_world);
  const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
  normalize_normals(mesh, glm::determinant(linear) == 0 ? cofactors : glm::transpose(glm::inverse(linear)));
  return true;
}

/// Leaves the triangles that `keep` names, and their attributes.
void keep_triangles(MeshData& mesh, std::span<const std::uint32_t> keep) {
  for (std::size_t i = 0; i < keep.size(); ++i) mesh.triangles[i] = mesh.triangles[keep[i]];
  mesh.triangles.resize(keep.size());
  for (MeshAttribute& attribute : mesh.attributes) {
    if (!attribute.per_face) continue;
    const std::size_t channels = attribute.channels;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      for (std::size_t k = 0; k < channels; ++k)
        attribute.values[i * channels + k] = attribute.values[keep[i] * channels + k];
    }
    attribute.values.resize(keep.size() * channels);
  }
}

void drop_degenerate_triangles(MeshData& mesh, Parameters& p) {
  const std::size_t before = mesh.triangles.size();
  const auto has_area = [&](const Triangle& t) {
    return std::isnormal(static_cast<float>(glm::length(area_normal(mesh, t)) / 2));
  };
  if (!std::all_of(mesh.triangles.begin(), mesh.triangles.end(), has_area)) {
    Array<std::uint32_t> keep;
    for (std::size_t i = 0; i < before; ++i) {
      if (has_area(mesh.triangles[i])) keep.push_back(static_cast<std::uint32_t>(i));
    }
    keep_triangles(mesh, keep);
  }
  const std::size_t dropped = before - mesh.triangles.size();
  if (mesh.triangles.empty() && before != 0) {
    p.diagnostics().warning(p.where(p.has(kFilename.name) ? kFilename.name : kToWorld.name),
                            "no triangle of the shape has an area, nothing of it is drawn");
  } else if (dropped != 0) {
    p.diagnostics().warning(p.where(kFilename.name),
                            fmt::format("{} of {} triangles {} no area and {} left out", dropped, before,
                                        dropped == 1 ? "has" : "have", dropped == 1 ? "is" : "are"));
  }
  if (mesh.triangles.empty()) mesh = {};
}

struct MeshParameters {
  glm::dmat4 to_world;
  bool face_normals, flip_normals;
};

MeshParameters read_mesh_parameters(Parameters& p) {
  const glm::dmat4 to_world = p.read(kToWorld);
  const bool face_normals = p.read(kFaceNormals);
  return {to_world, face_normals, p.read(kFlipNormals)};
}

/// The file's bytes are let go of when they have been read.
std::optional<MeshData> read_file(const std::string& path, Parameters& p, Shapes& shapes, const ReadMesh& read) {
  const std::optional<FileContents> contents = read_shape_file(path, kFilename.name, p, shapes);
  return contents ? read(contents->bytes, path, p.diagnostics()) : std::nullopt;
}

}  // namespace

void reverse_winding(MeshData& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) rewind_triangle(mesh, i);
}

void compute_normals(MeshData& mesh) {
  constexpr float kPi = static_cast<float>(std::numbers::pi);
  mesh.normals.assign(mesh.positions.size(), {0, 0, 0});
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = to_dvec(mesh.positions[t[0]]);
    const glm::dvec3 ab = to_dvec(mesh.positions[t[1]]) - a, ac = to_dvec(mesh.positions[t[2]]) - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double area2 = glm::length(normal);
    if (!(area2 > 0 && std::isfinite(area2))) continue;
    // All three corners have the same cross product; the third angle is what the other two leave of a half turn.
    const auto angle = [area2](double dot) {
      const double scale = std::max(area2, std::abs(dot));
      return isa_host::atan2(static_cast<float>(area2 / scale), static_cast<float>(dot / scale)).v;
    };
    const float at_a = angle(glm::dot(ab, ac)), at_b = angle(glm::dot(ab, ab - ac));
    const glm::vec3 unit(normal / area2);
    const auto add = [&](std::uint32_t vertex, float weight) {
      for (int axis = 0; axis < 3; ++axis) mesh.normals[vertex][axis] += weight * unit[axis];
    };
    add(t[0], at_a);
    add(t[1], at_b);
    add(t[2], std::max(kPi - at_a - at_b, 0.0f));
  }
  normalize_normals(mesh, glm::dmat3(1));
}

bool normals_are_flat(const MeshData& mesh) {
  // 1 - cos of 0.003 degrees: what floats leave between equal normals, less than any curvature that could be seen.
  constexpr double kFlat = 1e-9;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 face_normal = glm::normalize(area_normal(mesh, t));
    for (const std::uint32_t vertex : t) {
      if (glm::dot(glm::normalize(to_dvec(mesh.normals[vertex])), face_normal) < 1 - kFlat) return false;
    }
  }
  return true;
}

bool place_mesh(MeshData& mesh, const glm::dmat4& to_world, Parameters& p) {
  if (!move_to_world(mesh, to_world, p)) return false;
  drop_degenerate_triangles(mesh, p);
  if (!mesh.normals.empty()) {
    fill_missing_normals(mesh);
    wind_as_normals_say(mesh);
  }
  return true;
}

std::optional<ShapeGeometry> compile_mesh_file(Parameters& p, Shapes& shapes, const ReadMesh& read,
                                               std::optional<BooleanParameter> flip_tex_coords) {
  const std::string path = p.read(kFilename);
  const bool flips = flip_tex_coords && p.read(*flip_tex_coords);
  std::optional<MeshData> mesh;
  if (!path.empty()) mesh = read_file(path, p, shapes, read);
  if (!mesh) {
    read_mesh_parameters(p);
    return std::nullopt;
  }
  if (flips) {
    for (auto& texcoord : mesh->texcoords) texcoord[1] = 1 - texcoord[1];
  }
  return compile_mesh(p, shapes, *std::move(mesh));
}

std::optional<ShapeGeometry> compile_mesh(Parameters& p, Shapes& shapes, MeshData mesh) {
  auto [to_world, face_normals, flip_normals] = read_mesh_parameters(p);
  face_normals |= mesh.face_normals;
  if (face_normals) mesh.normals = {};
  if (!place_mesh(mesh, to_world, p)) return std::nullopt;
  if (!face_normals && mesh.normals.empty()) {
    compute_normals(mesh);
    fill_missing_normals(mesh);
  }
  if (!mesh.normals.empty() && normals_are_flat(mesh)) mesh.normals = {};
  if (flip_normals) {
    reverse_winding(mesh);
    for (auto& normal : mesh.normals) normal = to_float(-to_dvec(normal));
  }
  shapes.describe(p.node(), fmt::format("{} triangle{}{}", mesh.triangles.size(), mesh.triangles.size() == 1 ? "" : "s",
                                        mesh.normals.empty() ? "" : ", smooth"));
  ShapeGeometry geometry;
  geometry.mesh = std::move(mesh);
  return geometry;
}

}  // namespace norrsken
