#include "compile/geometry_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace norrsken {
namespace {

/// Three times an index must fit the 32-bit lanes that gather.
constexpr std::size_t kMaxElements = std::size_t{1} << 29;

/// Room for `count` more and something to spare, which costs nothing before it is touched: what comes behind a large
/// mesh must not make it move, and many small ones must not move what is there each time.
template <class T>
void make_room(std::size_t count, Array<T>& values) {
  if (values.capacity() - values.size() >= count) return;
  const std::size_t needed = values.size() + count;
  const std::size_t spare = std::max(needed + count / 8, values.size() + values.size() / 2);
  const std::shared_ptr<MemoryBudget> memory = values.get_allocator().budget();
  // What is only to spare is not worth refusing a scene that fits.
  values.reserve(memory && memory->left() < spare * sizeof(T) ? needed : spare);
}

/// Copies `from` behind `to` and frees it.
template <class T, std::size_t N>
void append(Array<std::array<T, N>>&& from, Array<T>& to) {
  const Array<std::array<T, N>> source = std::move(from);
  if (source.empty()) return;
  make_room(N * source.size(), to);
  to.insert(to.end(), source.front().data(), source.front().data() + N * source.size());
}

void store_rows(const glm::dmat4& map, float rows[12]) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) rows[4 * row + column] = static_cast<float>(map[column][row]);
  }
}

}  // namespace

Placement make_placement(const glm::dmat4& world_from_local) {
  Placement place;
  store_rows(world_from_local, place.world_from_local);
  store_rows(glm::inverse(world_from_local), place.local_from_world);
  return place;
}

void GeometryBuilder::Box::extend(const glm::dvec3& p, double radius) {
  lower = glm::min(lower, p - radius);
  upper = glm::max(upper, p + radius);
}

/// The image of a box lies within that of its corners.
void GeometryBuilder::Box::extend(const Box& box, const glm::dmat4& map) {
  if (box.empty()) return;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
                       (corner & 4) != 0 ? box.upper.z : box.lower.z);
    extend(glm::dvec3(map * glm::dvec4(p, 1)));
  }
}

Array<SurfaceRecord>& GeometryBuilder::surfaces(Class of) {
  return of == Class::triangles ? tables_.surfaces : of == Class::sphere ? spheres_ : analytics_;
}

std::span<SurfaceRecord> GeometryBuilder::surfaces_of(std::uint32_t shape) {
  const ShapeRecord& record = tables_.shapes[shape];
  return std::span(surfaces(classes_[shape])).subspan(record.first_primitive, record.primitive_count);
}

std::uint32_t GeometryBuilder::add(ShapeGeometry geometry, Material material) {
  const std::uint32_t shape = next_shape();
  const Class of = !geometry.spheres.empty() ? Class::sphere : geometry.analytic ? Class::analytic : Class::triangles;
  classes_.push_back(of);
  ShapeRecord record;
  record.first_primitive = static_cast<std::uint32_t>(surfaces(of).size());
  record.smooth = !geometry.mesh.normals.empty();
  record.has_texcoords = !geometry.mesh.texcoords.empty();
  record.group = group_;
  record.variation = material.variation;
  Box box;
  switch (of) {
    case Class::triangles:
      add_triangles(std::move(geometry.mesh), material, box);
      if (record.smooth != 0) tell_turns(record.first_primitive);
      break;
    case Class::sphere:
      add_spheres(geometry.spheres, material, record, box);
      break;
    case Class::analytic:
      add_analytic(*geometry.analytic, material, box);
      break;
  }
  record.primitive_count = static_cast<std::uint32_t>(surfaces(of).size()) - record.first_primitive;
  tables_.shapes.push_back(record);
  boxes_[group_].extend(box, glm::dmat4(1));
  if (!in_group()) latest_ = box;
  return shape;
}

void GeometryBuilder::add_spheres(const std::vector<ShapeGeometry::Sphere>& spheres, Material material,
                                  ShapeRecord& record, Box& box) {
  for (const ShapeGeometry::Sphere& sphere : spheres) {
    SurfaceRecord surface{{}, material.front, material.back, next_shape()};
    for (int axis = 0; axis < 3; ++axis) surface.geometry[axis] = static_cast<float>(sphere.center[axis]);
    surface.geometry[3] = static_cast<float>(sphere.radius);
    spheres_.push_back(surface);
    record.flip_normals = sphere.flip_normals;
    record.object_from_world = sphere.object_from_world;
    const float* g = surface.geometry;
    box.extend(glm::dvec3(g[0], g[1], g[2]), double{g[3]});
  }
}

void GeometryBuilder::add_analytic(const AnalyticShape& analytic, Material material, Box& box) {
  SurfaceRecord surface{{}, material.front, material.back, next_shape()};
  surface.geometry[0] = std::bit_cast<float>(static_cast<std::uint32_t>(tables_.analytics.size()));
  const std::uint32_t primitives = analytic.elements_are_primitives ? analytic.element_count : 1;
  for (std::uint32_t element = 0; element < primitives; ++element) {
    surface.geometry[1] = std::bit_cast<float>(element);
    analytics_.push_back(surface);
  }
  tables_.analytics.push_back({make_placement(analytic.world_from_local), analytic.kind,
                               analytic.flip_normals ? 1u : 0u, static_cast<float>(analytic.area),
                               static_cast<std::uint32_t>(tables_.texels.size()), analytic.element_count});
  tables_.texels.insert(tables_.texels.end(), analytic.table.begin(), analytic.table.end());
  box.extend({analytic.lower, analytic.upper}, analytic.world_from_local);
}

void GeometryBuilder::add_triangles(MeshData mesh, Material material, Box& box) {
  SceneTables& t = tables_;
  const std::size_t base = t.positions.size() / 3;
  if (base + mesh.positions.size() > kMaxElements || t.surfaces.size() + mesh.triangles.size() > kMaxElements) {
    diagnostics_.error({}, "the scene has too many triangles", fmt::format("{} vertices and triangles", kMaxElements));
    return;
  }
  append(std::move(mesh.positions), t.positions);
  // Per-vertex arrays exist for all vertices as soon as one shape needs them.
  if (!t.normals.empty() || !mesh.normals.empty()) {
    t.normals.resize(3 * base);
    append(std::move(mesh.normals), t.normals);
    t.normals.resize(t.positions.size());
  }
  if (!t.texcoords.empty() || !mesh.texcoords.empty()) {
    t.texcoords.resize(2 * base);
    append(std::move(mesh.texcoords), t.texcoords);
    t.texcoords.resize(t.positions.size() / 3 * 2);
  }
  const std::size_t first = t.triangle_vertices.size();
  append(std::move(mesh.triangles), t.triangle_vertices);
  for (std::size_t i = first; i < t.triangle_vertices.size(); ++i)
    t.triangle_vertices[i] += static_cast<std::uint32_t>(base);

  const auto corner = [&](std::size_t i) {
    const float* p = t.positions.data() + std::size_t{3} * t.triangle_vertices[i];
    return glm::dvec3(p[0], p[1], p[2]);
  };
  make_room((t.triangle_vertices.size() - first) / 3, t.surfaces);
  for (std::size_t i = first; i < t.triangle_vertices.size(); i += 3) {
    const glm::dvec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
    for (const glm::dvec3& p : {a, b, c}) box.extend(p);
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    t.surfaces.push_back({{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
                           static_cast<float>(glm::dot(n, a))},
                          material.front,
                          material.back,
                          next_shape()});
  }
}

void GeometryBuilder::tell_turns(std::size_t first_triangle) {
  SceneTables& t = tables_;
  const auto vector = [](const float* v) { return glm::dvec3(v[0], v[1], v[2]); };
  for (std::size_t i = first_triangle; i < t.surfaces.size(); ++i) {
    const glm::dvec3 face = vector(t.surfaces[i].geometry);
    glm::dvec3 corners[3];
    double least = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t vertex = std::size_t{3} * t.triangle_vertices[3 * i + k];
      corners[k] = vector(&t.positions[vertex]);
      least = std::min(least, glm::dot(vector(&t.normals[vertex]), face));
    }
    // In a sliver rounding takes the place between the corners, and with it the normal, anywhere.
    const glm::dvec3 a = corners[1] - corners[0], b = corners[2] - corners[0];
    const double product = glm::dot(a, a) * glm::dot(b, b), between = glm::dot(a, b);
    constexpr double kSliver = 1e-4;
    const bool usable = least > 0 && product - between * between > kSliver * product;
    // For what rounding does to normals, directions and weights.
    constexpr double kReserve = 1e-3;
    t.surfaces[i].turned_below =
        static_cast<float>(usable ? std::sqrt(std::max(1 - least * least, 0.0)) + kReserve : 2);
  }
}

void GeometryBuilder::set_light(std::uint32_t shape, std::uint32_t primitive, std::uint32_t light) {
  ShapeRecord& record = tables_.shapes[shape];
  Array<std::uint32_t>& lights = tables_.primitive_lights;
  if (record.lights == kNone) {
    record.lights = static_cast<std::uint32_t>(lights.size());
    lights.resize(lights.size() + record.primitive_count, kNone);
  }
  lights[record.lights + primitive] = light;
}

std::uint32_t GeometryBuilder::end_group() {
  const std::uint32_t ended = group_;
  group_ = kNone;
  return ended;
}

bool GeometryBuilder::add_instance(std::uint32_t group, const glm::dmat4& world_from_object) {
  Box box;
  box.extend(boxes_[group], world_from_object);
  for (int axis = 0; axis < 3 && !box.empty(); ++axis) {
    if (!(box.lower[axis] >= -kMaxCoordinate && box.upper[axis] <= kMaxCoordinate)) return false;
  }
  boxes_[kNone].extend(box, glm::dmat4(1));
  latest_ = box;
  tables_.instances.push_back({make_placement(world_from_object), group});
  return true;
}

void GeometryBuilder::finish(SceneInfo& info) {
  SceneTables& t = tables_;
  const std::uint32_t triangles = t.triangle_count();
  const auto spheres = static_cast<std::uint32_t>(spheres_.size());
  for (std::uint32_t shape = 0; shape < t.shapes.size(); ++shape) {
    if (is_sphere(shape)) t.shapes[shape].first_primitive += triangles;
    if (is_analytic(shape)) t.shapes[shape].first_primitive += triangles + spheres;
  }
  t.surfaces.insert(t.surfaces.end(), spheres_.begin(), spheres_.end());
  if (!analytics_.empty()) t.first_analytic = triangles + spheres;
  t.surfaces.insert(t.surfaces.end(), analytics_.begin(), analytics_.end());

  const Box& box = boxes_[kNone];
  if (box.empty()) return;
  const glm::dvec3 extent = box.upper - box.lower;
  for (int axis = 0; axis < 3; ++axis) {
    info.bounds_min[axis] = box.lower[axis];
    info.bounds_max[axis] = box.upper[axis];
    t.center[axis] = static_cast<float>(box.lower[axis] + extent[axis] / 2);
  }
  t.radius = static_cast<float>(glm::length(extent) / 2);
}

}  // namespace norrsken
