// cylinder: between two points of its axis, open at both ends; its normals point away from the axis.
//
// u is the angle around the axis in turns, v goes from p0 to p1. A mirroring `to_world` leaves the normals outwards, as in
// Mitsuba 3.9.
// Up to a percent that `to_world` makes the cross-section an ellipse by, or shears it, is left out.
// Departures: Mitsuba warns of a `to_world` that makes no cylinder and renders one; here it is an error. A mirrored
// cylinder that shines does so outwards for light sampling too; Mitsuba 3.9 samples light from its inside, whereas rays
// find it on the outside, so that what stands around it is too dark there.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "compile/shapes.h"
#include "math/frame.h"
#include "shape/analytic_host.h"

namespace norrsken {
namespace {

constexpr PointParameter kP0{.name = "p0", .text = "where the axis begins", .unit = "scene units"};
constexpr PointParameter kP1{.name = "p1", .fallback = {0, 0, 1}, .text = "where the axis ends", .unit = "scene units"};
constexpr NumberParameter kRadius{.name = "radius", .fallback = 1, .range = {0, kMaxCoordinate}, .unit = "scene units"};
constexpr TransformParameter kToWorld{
    .name = "to_world",
    .text =
        "applied to the cylinder of those; it may scale along the axis otherwise than across, but the cross-section "
        "must stay a circle at right angles to the axis",
    .flat = Flat::yes};
constexpr BooleanParameter kFlipNormals{.name = "flip_normals", .text = "the normals point to the axis"};

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

/// How far a linear map is from keeping the cross-section a circle and the axis across it, relative.
double deviation_from_cylinder(const glm::dmat3& linear) {
  const double a = glm::length(linear[0]), b = glm::length(linear[1]), c = glm::length(linear[2]);
  return std::max({std::abs(b * b / (a * a) - 1), std::abs(glm::dot(linear[0], linear[1])) / (a * b),
                   std::abs(glm::dot(linear[0], linear[2])) / (a * c),
                   std::abs(glm::dot(linear[1], linear[2])) / (b * c)});
}

/// Makes the cross-section a circle of that radius across the axis.
void straighten(glm::dmat4& world_from_local, double radius) {
  const glm::dvec3 axis(world_from_local[2]), n = glm::normalize(axis);
  const glm::dvec3 first(world_from_local[0]), second(world_from_local[1]);
  const glm::dvec3 s = glm::normalize(first - glm::dot(first, n) * n), t = glm::cross(n, s);
  world_from_local[0] = glm::dvec4(s * radius, 0);
  world_from_local[1] = glm::dvec4(t * (glm::dot(t, second) < 0 ? -radius : radius), 0);
}

}  // namespace

std::optional<ShapeGeometry> compile_shape_cylinder(Parameters& p, Shapes& shapes) {
  const glm::dvec3 p0 = p.read(kP0), p1 = p.read(kP1);
  const double radius = p.read(kRadius);
  const glm::dmat4 to_world = p.read(kToWorld);
  const bool flip_normals = p.read(kFlipNormals);
  if (p0 == p1) return nothing_to_draw(p, "length", 0);
  if (radius == 0 || glm::dmat3(to_world) == glm::dmat3(0)) return nothing_to_draw(p, "radius", 0);
  glm::dmat4 world_from_local = to_world * cylinder_from_local(p0, p1 - p0, radius);
  const glm::dmat3 linear(world_from_local);
  const glm::dmat3 placement(to_world);
  const double scale = std::min({glm::length(placement[0]), glm::length(placement[1]), glm::length(placement[2])});
  if (!keeps_shape(deviation_from_cylinder(linear), scale, p,
                   "'to_world' makes the cylinder's cross-section an ellipse or shears it",
                   "translations, rotations and scales with one value or along the axis"))
    return std::nullopt;
  const double world_radius = std::sqrt(glm::length(linear[0]) * glm::length(linear[1])),
               length = glm::length(linear[2]);
  shapes.describe(p.node(), fmt::format("radius {:.6g}, length {:.6g}", world_radius, length));
  straighten(world_from_local, world_radius);
  return place_analytic(
      {AnalyticKind::cylinder, world_from_local, 2 * std::numbers::pi * world_radius * length, flip_normals}, p);
}

}  // namespace norrsken
