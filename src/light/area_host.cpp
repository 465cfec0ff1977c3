#include "light/area_host.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <optional>

namespace norrsken {
namespace {

using Corner = std::array<float, 3>;
using Corners = std::array<Corner, 3>;
/// A directed edge by position, so that triangles that only share places, not vertices, are neighbours too.
using Edge = std::pair<Corner, Corner>;

void store(float (&out)[3], const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

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
  store(light.origin, to_dvec(apex));
  store(light.edge1, edge1);
  store(light.edge2, edge2);
  store(light.normal, normal / parallelogram_area);
  return light;
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
std::map<Edge, std::uint32_t> edges_of(const std::vector<Corners>& triangles) {
  std::map<Edge, std::uint32_t> edges;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) edges[{triangles[i][k], triangles[i][(k + 1) % 3]}] = i;
  }
  return edges;
}

const Corner& corner_across(const Corners& triangle, const Edge& edge) {
  return *std::find_if(triangle.begin(), triangle.end(),
                       [&](const Corner& corner) { return corner != edge.first && corner != edge.second; });
}

std::vector<AreaLight> flat_lights(const std::vector<Corners>& triangles) {
  const auto edges = edges_of(triangles);
  std::vector<bool> taken(triangles.size(), false);
  std::vector<AreaLight> lights;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (taken[i]) continue;
    AreaLight light;
    light.primitives[0] = i;
    light.record = flat_light(LightKind::triangle, triangles[i][0], triangles[i][1], triangles[i][2]);
    for (std::size_t k = 0; k < 3 && light.primitives[1] == kNone; ++k) {
      const Corner &apex = triangles[i][k], &left = triangles[i][(k + 1) % 3], &right = triangles[i][(k + 2) % 3];
      // A neighbour that faces the same way runs along the shared edge in the other direction.
      const auto neighbour = edges.find({right, left});
      if (neighbour == edges.end() || neighbour->second <= i || taken[neighbour->second]) continue;
      const Corner& opposite = corner_across(triangles[neighbour->second], neighbour->first);
      if (!completes_parallelogram(apex, left, right, opposite)) continue;
      light.primitives[1] = neighbour->second;
      light.record = flat_light(LightKind::parallelogram, apex, left, right);
      taken[neighbour->second] = true;
    }
    lights.push_back(light);
  }
  return lights;
}

AreaLight sphere_light(const SurfaceRecord& sphere, bool flip_normals, std::uint32_t primitive) {
  AreaLight light;
  light.primitives[0] = primitive;
  light.record.kind = LightKind::sphere;
  const double radius = sphere.geometry[3];
  light.record.area = static_cast<float>(4 * std::numbers::pi * radius * radius);
  std::copy_n(sphere.geometry, 3, light.record.origin);
  light.record.edge1[0] = sphere.geometry[3];
  light.record.edge1[1] = flip_normals ? 1.0f : 0.0f;
  return light;
}

}  // namespace

std::vector<AreaLight> area_lights(Builder& builder, std::uint32_t shape) {
  const auto surfaces = builder.surfaces_of(shape);
  const ShapeRecord& record = builder.tables().shapes[shape];
  if (builder.is_sphere(shape)) {
    std::vector<AreaLight> lights;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
      lights.push_back(sphere_light(surfaces[i], record.flip_normals != 0, i));
    }
    return lights;
  }
  std::vector<Corners> triangles;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    triangles.push_back(corners_of(builder.tables(), record.first_primitive + i));
  }
  return flat_lights(triangles);
}

}  // namespace norrsken
