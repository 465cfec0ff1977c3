// cylinder: between two points of its axis, open at both ends; its normals point away from the axis.
//
// Parameters
//   p0, p1        points, scene units (defaults 0 0 0 and 0 0 1): the ends of the axis
//   radius        number above 0, scene units (default 1)
//   to_world      transform (default identity), applied to the cylinder of those; it may scale along the axis otherwise
//                 than across, but the cross-section must stay a circle at right angles to the axis
//   flip_normals  boolean (default false): the normals point to the axis
// u is the angle around the axis in turns, v goes from p0 to p1. A mirroring `to_world` leaves the normals outwards, as in
// Mitsuba 3.9.
// Departures: Mitsuba warns of a `to_world` that makes no cylinder and renders one; here it is an error. A mirrored
// cylinder that shines does so outwards for light sampling too; Mitsuba 3.9 samples light from its inside, whereas rays
// find it on the outside, so that what stands around it is too dark there.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "compile/plugins.h"
#include "math/frame.h"
#include "shape/analytic_host.h"

namespace norrsken {
namespace {

/// As for spheres: what ten digits of a matrix written out by hand or a chain of rotations may leave.
constexpr double kTolerance = 1e-5;

glm::dvec3 to_dvec(const isa_host::Vec3f& v) { return {v.x.v, v.y.v, v.z.v}; }

/// From the unit cylinder of the z axis to that between two points.
glm::dmat4 cylinder_from_local(const glm::dvec3& p0, const glm::dvec3& axis, double radius) {
  const glm::dvec3 n = glm::normalize(axis);
  // Around n in the way of Mitsuba's frames, because v = 0 is where the first axis points.
  const isa_host::Frame frame =
      isa_host::make_frame({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
  const glm::dvec3 t = glm::normalize(glm::cross(n, to_dvec(frame.s))), s = glm::cross(t, n);
  return {glm::dvec4(s * radius, 0), glm::dvec4(t * radius, 0), glm::dvec4(axis, 0), glm::dvec4(p0, 1)};
}

bool is_cylinder(const glm::dmat3& linear) {
  const double a = glm::length(linear[0]), b = glm::length(linear[1]), c = glm::length(linear[2]);
  return std::abs(a - b) <= kTolerance * a && std::abs(glm::dot(linear[0], linear[1])) <= kTolerance * a * b &&
         std::abs(glm::dot(linear[0], linear[2])) <= kTolerance * a * c &&
         std::abs(glm::dot(linear[1], linear[2])) <= kTolerance * b * c;
}

}  // namespace

std::optional<ShapeGeometry> compile_shape_cylinder(Parameters& p, Builder& builder) {
  const glm::dvec3 p0 = p.point("p0", glm::dvec3(0)), p1 = p.point("p1", glm::dvec3(0, 0, 1));
  const double radius = p.number("radius", 1, 0, kMaxCoordinate, Ends::open_below);
  const glm::dmat4 to_world = p.transform("to_world");
  const bool flip_normals = p.boolean("flip_normals", false);
  if (p0 == p1) {
    p.error(p.has("p1") ? "p1" : "p0", "the cylinder's ends 'p0' and 'p1' are the same point", "two points");
    return std::nullopt;
  }
  const glm::dmat4 world_from_local = to_world * cylinder_from_local(p0, p1 - p0, radius);
  const glm::dmat3 linear(world_from_local);
  if (!is_cylinder(linear)) {
    p.error("to_world", "'to_world' makes the cylinder's cross-section an ellipse or shears it",
            "translations, rotations and scales with one value or along the axis");
    return std::nullopt;
  }
  const double world_radius = glm::length(linear[0]), length = glm::length(linear[2]);
  builder.describe(p.node(), fmt::format("radius {:.6g}, length {:.6g}", world_radius, length));
  return place_analytic(
      {AnalyticKind::cylinder, world_from_local, 2 * std::numbers::pi * world_radius * length, flip_normals}, p);
}

}  // namespace norrsken
