// disk: the unit disk of the xy plane, facing +z.
//
// Parameters
//   to_world      transform (default identity); any, which makes ellipses too
//   flip_normals  boolean (default false): face -z instead
// u is the distance from the centre, 1 at the edge, v the angle from the local x axis in turns. The normal is that of
// Mitsuba: +z taken through the inverse transpose of `to_world`, so a mirroring placement does not turn it around.
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "compile/plugins.h"
#include "shape/analytic_host.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_disk(Parameters& p, Builder& builder) {
  const glm::dmat4 to_world = p.transform("to_world");
  const bool flip_normals = p.boolean("flip_normals", false);
  const double area = std::numbers::pi * glm::length(glm::cross(glm::dvec3(to_world[0]), glm::dvec3(to_world[1])));
  builder.describe(p.node(), fmt::format("area {:.6g}", area));
  return place_analytic({.kind = AnalyticKind::disk,
                         .world_from_local = to_world,
                         .area = area,
                         .flip_normals = flip_normals,
                         .upper = {1, 1, 0}},
                        p);
}

}  // namespace norrsken
