#include "light/area_host.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <span>

#include "light/light_host.h"
#include "light/models.h"
#include "shape/models.h"

namespace norrsken {
namespace {

using Corner = std::array<float, 3>;
using Corners = std::array<Corner, 3>;
/// A directed edge by position, so that triangles that only share places, not vertices, are neighbours too.
using Edge = std::pair<Corner, Corner>;

glm::dvec3 to_dvec(const Corner& c) { return {c[0], c[1], c[2]}; }

Corners corners_of(const SceneTables& tables, std::size_t triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t vertex = tables.triangle_vertices[3 * triangle + k];
    std::copy_n(&tables.positions[3 * vertex], 3, corners[k].begin());
  }
  return corners;
}

/// The light with corner `apex` and the edges to `left` and `right`, counter-clockwise seen from its front.
LightRecord flat_light(LightKind kind, const Corner& apex, const Corner& left, const Corner& right) {
  LightRecord light{};
  light.kind = kind;
  const glm::dvec3 edge1 = to_dvec(left) - to_dvec(apex), edge2 = to_dvec(right) - to_dvec(apex);
  const glm::dvec3 normal = glm::cross(edge1, edge2);
  const double parallelogram_area = glm::length(normal);
  light.area = static_cast<float>(kind == LightKind::triangle ? parallelogram_area / 2 : parallelogram_area);
  set_values(light.origin, to_dvec(apex));
  set_values(light.edge1, edge1);
  set_values(light.edge2, edge2);
  set_values(light.normal, normal / parallelogram_area);
  return light;
}

/// A flat light's: it shines to one side.
LightBounds flat_bounds(const LightRecord& light) {
  const glm::dvec3 origin = to_dvec(std::to_array(light.origin)), edge1 = to_dvec(std::to_array(light.edge1)),
                   edge2 = to_dvec(std::to_array(light.edge2));
  // Of a triangle there is no fourth corner.
  const glm::dvec3 last = light.kind == LightKind::parallelogram ? origin + edge1 + edge2 : origin;
  return {.lower = glm::min(glm::min(origin, last), glm::min(origin + edge1, origin + edge2)),
          .upper = glm::max(glm::max(origin, last), glm::max(origin + edge1, origin + edge2)),
          .axis = to_dvec(std::to_array(light.normal)),
          .normals = 0};
}

/// Whether `opposite` completes `apex`, `left`, `right` to a parallelogram whose diagonal is left-right.
bool completes_parallelogram(const Corner& apex, const Corner& left, const Corner& right, const Corner& opposite) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = double{left[axis]} + double{right[axis]} - double{apex[axis]} - double{opposite[axis]};
    const double size =
        std::max({std::abs(left[axis]), std::abs(right[axis]), std::abs(apex[axis]), std::abs(opposite[axis])});
    // Each of four coordinates was rounded by half an ulp at most.
    if (std::abs(gap) > 4 * (FLT_EPSILON / 2) * size) return false;
  }
  return true;
}

/// The shape's triangles by directed edge; of several with one edge, the last.
std::map<Edge, std::uint32_t> edges_of(std::span<const Corners> triangles) {
  std::map<Edge, std::uint32_t> edges;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) edges[{triangles[i][k], triangles[i][(k + 1) % 3]}] = i;
  }
  return edges;
}

std::size_t corner_across(const Corners& triangle, const Edge& edge) {
  const auto corner = std::find_if(triangle.begin(), triangle.end(),
                                   [&](const Corner& c) { return c != edge.first && c != edge.second; });
  return static_cast<std::size_t>(corner - triangle.begin());
}

using Texcoord = std::array<double, 2>;

/// Texture coordinates at the corners; barycentric ones where the mesh has none.
std::array<Texcoord, 3> texcoords_of(const SceneTables& tables, std::size_t triangle, bool has_texcoords) {
  std::array<Texcoord, 3> uv{{{0, 0}, {1, 0}, {0, 1}}};
  for (std::size_t k = 0; has_texcoords && k < 3; ++k) {
    const std::size_t vertex = tables.triangle_vertices[3 * triangle + k];
    for (std::size_t i = 0; i < 2; ++i) uv[k][i] = double{tables.texcoords[2 * vertex + i]};
  }
  return uv;
}

/// A shape's triangles, and what the texture of their radiance needs.
struct FlatMesh {
  Array<Corners> triangles;
  Array<std::array<Texcoord, 3>> texcoords;
  std::uint32_t first_primitive, shape;
  TextureWord texture;
  bool smooth;  ///< lights are to know the vertices' normals
  bool merge;
};

/// What FlatAreaLight's texture and normals ask for: see src/light/flat_area.h. `apex` is the corner that the light
/// begins with.
std::uint32_t store(Lights& lights, const FlatMesh& mesh, std::size_t triangle, std::size_t apex) {
  const auto& uv = mesh.texcoords[triangle];
  const Texcoord &origin = uv[apex], &left = uv[(apex + 1) % 3], &right = uv[(apex + 2) % 3];
  return lights.store(isa_host::FlatAreaStored{.texture = mesh.texture,
                                               .u = static_cast<float>(origin[0]),
                                               .v = static_cast<float>(origin[1]),
                                               .left_u = static_cast<float>(left[0] - origin[0]),
                                               .left_v = static_cast<float>(left[1] - origin[1]),
                                               .right_u = static_cast<float>(right[0] - origin[0]),
                                               .right_v = static_cast<float>(right[1] - origin[1]),
                                               .primitive = mesh.first_primitive + static_cast<std::uint32_t>(triangle),
                                               .shape = mesh.shape});
}

/// Whether the texture coordinates of two triangles that make a parallelogram are one map of it: `apex` is the first's
/// corner off their common edge, `opposite` the second's.
bool is_one_map(const FlatMesh& mesh, std::size_t first, std::size_t apex, std::size_t second, std::size_t opposite) {
  if (mesh.texture == 0) return true;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto first_uv = [&](std::size_t k) { return mesh.texcoords[first][(apex + k) % 3][i]; };
    const auto second_uv = [&](std::size_t k) { return mesh.texcoords[second][(opposite + k) % 3][i]; };
    const double size = std::max({std::abs(first_uv(0)), std::abs(first_uv(1)), std::abs(first_uv(2)), 1.0});
    const auto equal = [&](double a, double b) { return std::abs(a - b) <= 4 * FLT_EPSILON * size; };
    if (!equal(first_uv(1), second_uv(2)) || !equal(first_uv(2), second_uv(1)) ||
        !equal(second_uv(0), first_uv(1) + first_uv(2) - first_uv(0)))
      return false;
  }
  return true;
}

std::vector<AreaLight> flat_lights(Lights& lights, const FlatMesh& mesh) {
  std::span<const Corners> triangles = mesh.triangles;
  // Three nodes of the tree of edges for each triangle, and the light's record with its list of primitives.
  constexpr std::size_t kNodeBytes = sizeof(std::pair<const Edge, std::uint32_t>) + 6 * sizeof(void*);
  const MemoryReservation working(triangles.size() * (3 * kNodeBytes + sizeof(AreaLight) + 4 * sizeof(void*)));
  const auto edges = edges_of(triangles);
  std::vector<bool> taken(triangles.size(), false);
  std::vector<AreaLight> found;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (taken[i]) continue;
    AreaLight light;
    light.primitives = {i};
    light.record = flat_light(LightKind::triangle, triangles[i][0], triangles[i][1], triangles[i][2]);
    std::size_t first_corner = 0;
    for (std::size_t k = 0; mesh.merge && k < 3 && light.primitives.size() == 1; ++k) {
      const Corner &apex = triangles[i][k], &left = triangles[i][(k + 1) % 3], &right = triangles[i][(k + 2) % 3];
      // A neighbour that faces the same way runs along the shared edge in the other direction.
      const auto neighbour = edges.find({right, left});
      if (neighbour == edges.end() || neighbour->second <= i || taken[neighbour->second]) continue;
      const std::size_t across = corner_across(triangles[neighbour->second], neighbour->first);
      if (!completes_parallelogram(apex, left, right, triangles[neighbour->second][across])) continue;
      if (!is_one_map(mesh, i, k, neighbour->second, across)) continue;
      light.primitives.push_back(neighbour->second);
      light.record = flat_light(LightKind::parallelogram, apex, left, right);
      first_corner = k;
      taken[neighbour->second] = true;
    }
    if (mesh.texture != 0 || mesh.smooth) light.record.parameters = store(lights, mesh, i, first_corner);
    light.bounds = flat_bounds(light.record);
    found.push_back(std::move(light));
  }
  return found;
}

AreaLight sphere_light(const SurfaceRecord& sphere, bool flip_normals, std::uint32_t primitive) {
  AreaLight light;
  light.primitives = {primitive};
  light.record.kind = LightKind::sphere;
  const double radius = sphere.geometry[3];
  light.record.area = static_cast<float>(4 * std::numbers::pi * radius * radius);
  std::copy_n(sphere.geometry, 3, light.record.origin);
  light.record.edge1[0] = sphere.geometry[3];
  light.record.edge1[1] = flip_normals ? 1.0f : 0.0f;
  const glm::dvec3 center(sphere.geometry[0], sphere.geometry[1], sphere.geometry[2]);
  light.bounds = {.lower = center - radius, .upper = center + radius};
  return light;
}

/// Of shapes whose area is sampled: all fit into a box of the local space. A disk faces one way.
LightBounds analytic_bounds(const AnalyticRecord& shape) {
  const float* m = shape.place.world_from_local;
  glm::dvec3 center, half, z;
  for (int i = 0; i < 3; ++i) {
    const float* row = m + std::ptrdiff_t{4} * i;
    center[i] = double{row[3]} + double{row[2]} / 2;
    half[i] = std::abs(double{row[0]}) + std::abs(double{row[1]}) + std::abs(double{row[2]}) / 2;
    z[i] = shape.place.local_from_world[8 + i];
  }
  LightBounds bounds{.lower = center - half, .upper = center + half};
  if (shape.kind != AnalyticKind::disk) return bounds;
  bounds.axis = glm::normalize(z) * (shape.flip_normals != 0 ? -1.0 : 1.0);
  bounds.normals = 0;
  return bounds;
}

bool can_be_sampled(AnalyticKind kind) {
  switch (kind) {
#define NORRSKEN_ANALYTIC(name, Model) \
  case AnalyticKind::name:             \
    return isa_host::kCanBeSampled<isa_host::Model>;
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC
    default:
      return false;
  }
}

/// The one light of a shape that may have many primitives.
std::vector<AreaLight> analytic_lights(Lights& lights, std::span<const SurfaceRecord> surfaces, TextureWord texture) {
  if (surfaces.empty()) return {};
  const auto analytic = std::bit_cast<std::uint32_t>(surfaces[0].geometry[0]);
  AreaLight light;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) light.primitives.push_back(i);
  light.record.kind = LightKind::analytic;
  light.record.area = lights.tables().analytics[analytic].area;
  light.sampled = can_be_sampled(lights.tables().analytics[analytic].kind);
  light.bounds = analytic_bounds(lights.tables().analytics[analytic]);
  light.record.parameters = lights.store(isa_host::AnalyticAreaLight::Stored{.texture = texture, .analytic = analytic});
  return {light};
}

}  // namespace

void refuse_as_beginning(const AreaLight& light, const Parameters& emitter, Lights& lights) {
  if (light.sampled || !lights.paths_begin_at_lights()) return;
  emitter.diagnostics().error(
      emitter.node().plugin_location,
      "paths cannot begin at the shape around this emitter, whose surface has no way to be sampled, as those of "
      "integrator 'ptracer' do",
      "another integrator, or another shape");
}

std::vector<AreaLight> area_lights(Lights& lights, std::uint32_t shape, TextureWord texture, bool along_normals) {
  const auto surfaces = lights.surfaces_of(shape);
  const ShapeRecord& record = lights.tables().shapes[shape];
  if (lights.is_analytic(shape)) return analytic_lights(lights, surfaces, texture);
  if (lights.is_sphere(shape)) {
    std::vector<AreaLight> found;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
      found.push_back(sphere_light(surfaces[i], record.flip_normals != 0, i));
      if (texture == 0) continue;
      found.back().record.parameters = lights.store(isa_host::SphereAreaStored{.texture = texture, .shape = shape});
    }
    return found;
  }
  const bool smooth = along_normals && record.smooth != 0, has_texcoords = record.has_texcoords != 0;
  FlatMesh mesh{{}, {}, record.first_primitive, shape, texture, smooth, !smooth};
  // Attributes belong to triangles, and so do coordinates that are barycentric.
  if (texture != 0) mesh.merge = mesh.merge && has_texcoords && texture_kind(texture) != TextureKind::mesh_attribute;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    mesh.triangles.push_back(corners_of(lights.tables(), record.first_primitive + i));
    if (texture != 0 || smooth) {
      mesh.texcoords.push_back(texcoords_of(lights.tables(), record.first_primitive + i, has_texcoords));
    }
  }
  return flat_lights(lights, mesh);
}

}  // namespace norrsken
