// disk: the unit disk of the xy plane, facing +z.
//
// u is the distance from the centre, 1 at the edge, v the angle from the local x axis in turns. The normal is that of
// Mitsuba: +z taken through the inverse transpose of `to_world`, so a mirroring placement does not turn it around.
#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compile/shapes.h"
#include "shape/analytic_host.h"

namespace norrsken {
namespace {

constexpr TransformParameter kToWorld{
    .name = "to_world", .text = "any, which makes ellipses too. It may scale z by 0", .flat = Flat::yes};
constexpr BooleanParameter kFlipNormals{.name = "flip_normals", .text = "face -z instead"};

}  // namespace

std::optional<ShapeGeometry> compile_shape_disk(Parameters& p, Shapes& shapes) {
  glm::dmat4 to_world = p.read(kToWorld);
  const bool flip_normals = p.read(kFlipNormals);
  const glm::dvec3 across = glm::cross(glm::dvec3(to_world[0]), glm::dvec3(to_world[1]));
  const double area = std::numbers::pi * glm::length(across);
  // Nothing of a disk lies along z, which only has to be somewhere off its plane.
  const glm::dvec3 z(to_world[2]);
  const bool is_flat = !(std::abs(glm::dot(across, z)) > 1e-12 * glm::length(across) * glm::length(z));
  if (is_flat && area > 0) to_world[2] = glm::dvec4(glm::normalize(across), 0);
  shapes.describe(p.node(), fmt::format("area {:.6g}", area));
  return place_analytic({.kind = AnalyticKind::disk,
                         .world_from_local = to_world,
                         .area = area,
                         .flip_normals = flip_normals,
                         .upper = {1, 1, 0}},
                        p);
}

}  // namespace norrsken
