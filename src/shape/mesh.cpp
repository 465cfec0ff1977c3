// mesh: triangles that the scene itself holds, in strings of numbers or in arrays of the program that makes it.
//
// Programs may give a `mesh` in place of the four arrays, with attributes for textures of type `mesh_attribute`.
// Departures: Mitsuba makes such meshes by Python alone.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/mesh_flaws.h"
#include "shape/mesh_host.h"

namespace norrsken {
namespace {

constexpr NumbersParameter kPositions{.name = "positions",
                                      .per_element = 3,
                                      .text = "x y z of each vertex",
                                      .example = R"(<string name="positions" value="0 0 0  1 0 0  0 1 0"/>)"};
constexpr NumbersParameter kTriangles{
    .name = "triangles",
    .per_element = 3,
    .text = "whole ones: three vertices each, counted from 0, counter-clockwise seen from the front",
    .example = R"(<string name="triangles" value="0 1 2"/>)"};
constexpr NumbersParameter kNormals{.name = "normals", .per_element = 3, .text = "x y z at each vertex, of any length"};
constexpr NumbersParameter kTexcoords{.name = "texcoords", .per_element = 2, .text = "u v of each vertex"};

/// Elements of N numbers out of a flat array.
template <std::size_t N, class T>
Array<std::array<T, N>> in_groups(std::span<const T> values) {
  Array<std::array<T, N>> groups(values.size() / N);
  for (std::size_t i = 0; i < groups.size(); ++i)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(N * i), N, groups[i].begin());
  return groups;
}

MeshData in_groups(std::span<const float> positions, std::span<const float> normals, std::span<const float> texcoords,
                   std::span<const std::uint32_t> triangles) {
  MeshData mesh;
  mesh.positions = in_groups<3>(positions);
  mesh.normals = in_groups<3>(normals);
  mesh.texcoords = in_groups<2>(texcoords);
  mesh.triangles = in_groups<3>(triangles);
  return mesh;
}

/// Complaints about what a mesh is made of; `name` is the parameter that they point at.
class Check {
 public:
  Check(Parameters& p, std::string_view name) : p_(p), name_(name) {}

  /// `each` values for each vertex or triangle; those of the used ones are looked at.
  void numbers(std::string_view what, std::span<const float> values, std::size_t each, const std::vector<bool>& used) {
    if (values.size() != each * used.size())
      return fail(fmt::format("the mesh has {} {}", values.size(), what),
                  fmt::format("{} of them", each * used.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!used[i / each] || std::abs(static_cast<double>(values[i])) <= kMaxCoordinate) continue;
      return fail(fmt::format("some {} of the mesh are not finite, or too large", what),
                  fmt::format("{:g} to {:g}", -kMaxCoordinate, kMaxCoordinate));
    }
  }
  /// Which vertices are those of triangles; what the others hold is nobody's concern.
  std::vector<bool> triangles(std::span<const std::uint32_t> triangles, std::size_t vertices) {
    if (triangles.size() % 3 != 0)
      fail(fmt::format("{} corners of the mesh's triangles", triangles.size()), "a multiple of 3");
    std::vector<bool> used(vertices);
    for (const std::uint32_t vertex : triangles) {
      if (vertex >= vertices) {
        fail(fmt::format("a triangle of the mesh has vertex {} of {}", vertex, vertices), "vertices counted from 0");
        break;
      }
      used[vertex] = true;
    }
    return used;
  }
  void attributes(std::span<const Mesh::Attribute> attributes, std::size_t triangles, const std::vector<bool>& used) {
    std::set<std::string_view> names;
    for (const Mesh::Attribute& attribute : attributes) {
      const bool per_face = attribute.name.starts_with("face_");
      if (!per_face && !attribute.name.starts_with("vertex_")) {
        fail(fmt::format("attribute '{}' of the mesh", attribute.name), "a name that begins with vertex_ or face_");
      } else if (!names.insert(attribute.name).second) {
        fail(fmt::format("the mesh has two attributes '{}'", attribute.name), "one of each name");
      } else if (attribute.channels != 1 && attribute.channels != 3) {
        fail(fmt::format("attribute '{}' of the mesh has {} channels", attribute.name, attribute.channels), "1 or 3");
      } else {
        numbers("values of attribute '" + attribute.name + "'", attribute.values,
                static_cast<std::size_t>(attribute.channels), per_face ? std::vector<bool>(triangles, true) : used);
      }
    }
  }
  bool good() const { return good_; }

 private:
  void fail(std::string message, std::string accepted) {
    good_ = false;
    p_.error(name_, std::move(message), std::move(accepted));
  }

  Parameters& p_;
  std::string_view name_;
  bool good_ = true;
};

/// The arrays, checked. Empty after a complaint.
std::optional<MeshData> read_arrays(Parameters& p) {
  const Array<float> positions = p.floats(kPositions), normals = p.floats(kNormals), texcoords = p.floats(kTexcoords);
  const Array<std::uint32_t> triangles = p.indices(kTriangles);
  if (positions.empty() || triangles.empty()) return std::nullopt;
  Check corners(p, kTriangles.name), at_normals(p, kNormals.name), at_texcoords(p, kTexcoords.name);
  const std::vector<bool> used = corners.triangles(triangles, positions.size() / 3);
  if (!normals.empty()) at_normals.numbers("components of normals", normals, 3, used);
  if (!texcoords.empty()) at_texcoords.numbers("texture coordinates", texcoords, 2, used);
  if (!corners.good() || !at_normals.good() || !at_texcoords.good()) return std::nullopt;
  return in_groups(positions, normals, texcoords, triangles);
}

std::optional<MeshData> copy_mesh(const Mesh& given, Parameters& p) {
  Check check(p, "mesh");
  const std::vector<bool> used = check.triangles(given.triangles, given.positions.size() / 3);
  check.numbers("coordinates", given.positions, 3, used);
  if (!given.normals.empty()) check.numbers("components of normals", given.normals, 3, used);
  if (!given.texcoords.empty()) check.numbers("texture coordinates", given.texcoords, 2, used);
  check.attributes(given.attributes, given.triangles.size() / 3, used);
  if (!check.good()) return std::nullopt;
  MeshData mesh = in_groups(given.positions, given.normals, given.texcoords, given.triangles);
  for (const Mesh::Attribute& attribute : given.attributes) {
    mesh.attributes.push_back({attribute.name,
                               static_cast<std::uint32_t>(attribute.channels),
                               attribute.name.starts_with("face_"),
                               {attribute.values.begin(), attribute.values.end()}});
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) mesh.positions[i] = {};
  }
  leave_out_not_finite(mesh);
  if (given.triangles.empty())
    p.diagnostics().warning(p.where("mesh"), "the mesh has no triangles, nothing of it is drawn");
  return mesh;
}

}  // namespace

std::optional<ShapeGeometry> compile_shape_mesh(Parameters& p, Shapes& shapes) {
  std::optional<MeshData> mesh;
  if (!p.has("mesh")) {
    mesh = read_arrays(p);
  } else if (const std::shared_ptr<const Mesh> given = p.mesh("mesh")) {
    mesh = copy_mesh(*given, p);
  }
  return compile_mesh(p, shapes, mesh ? *std::move(mesh) : MeshData{});
}

}  // namespace norrsken
