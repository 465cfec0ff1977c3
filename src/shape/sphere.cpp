// sphere: centre and radius.
//
// Parameters
//   center        point, scene units (default 0 0 0)
//   radius        number from 0, scene units (default 1)
//   to_world      transform (default identity), applied to the sphere of that centre and radius; its scale must be the
//                 same in all directions; up to a percent that it differs by is left out
//   flip_normals  boolean (default false): the normal points to the centre
// u turns around the local z axis, v goes from the pole at +z to that at -z. A mirroring `to_world` turns the normal around, as in Mitsuba.
// Departures: Mitsuba warns of a scale that differs between directions and renders a sphere; here it is an error.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "compile/plugins.h"
#include "shape/analytic_host.h"

namespace norrsken {
namespace {

/// How far a linear map is from a rotation times `scale`, relative.
double deviation_from_uniform(const glm::dmat3& linear, double scale) {
  const glm::dmat3 gram = glm::transpose(linear) * linear;
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(gram[i][j] / (scale * scale) - (i == j)));
  }
  return most;
}

/// Texture coordinates turn with the sphere. Returns where the rotation is stored, kNone if there is none.
std::uint32_t store_rotation(const glm::dmat3& object_from_world, Builder& builder) {
  const auto is_rounding = [](double difference) { return std::abs(difference) < 1e-12; };
  bool rotated = false;
  for (int i = 0; i < 9; ++i) rotated |= !is_rounding(object_from_world[i / 3][i % 3] - (i % 4 == 0));
  if (!rotated) return kNone;
  float rows[9];
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rows[3 * row + column] = static_cast<float>(object_from_world[column][row]);
  }
  return builder.add_parameters(rows);
}

}  // namespace

std::optional<ShapeGeometry> compile_shape_sphere(Parameters& p, Builder& builder) {
  const glm::dvec3 center = p.point("center", glm::dvec3(0));
  const double radius = p.number("radius", 1, 0, kMaxCoordinate);
  const glm::dmat4 to_world = p.transform("to_world", Flat::yes);
  const bool flip_normals = p.boolean("flip_normals", false);

  const glm::dmat3 linear(to_world);
  const double determinant = glm::determinant(linear);
  const double scale = std::cbrt(std::abs(determinant));
  if (radius == 0 || linear == glm::dmat3(0)) return nothing_to_draw(p, "radius", 0);
  if (!keeps_shape(deviation_from_uniform(linear, scale), scale, p,
                   "'to_world' does not scale the sphere alike in all directions",
                   "translations, rotations and scales with one value"))
    return std::nullopt;
  const glm::dvec3 world_center = to_world * glm::dvec4(center, 1);
  const double world_radius = radius * scale;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(world_center[axis]) <= kMaxCoordinate) || !(world_radius <= kMaxCoordinate)) {
      p.error("to_world", "the sphere is placed too far away or made too large",
              fmt::format("coordinates up to {:g}", kMaxCoordinate));
      return std::nullopt;
    }
  }
  if (!std::isnormal(static_cast<float>(world_radius))) {
    return nothing_to_draw(p, "radius", world_radius);
  }
  builder.describe(p.node(), fmt::format("radius {:.6g}", world_radius));
  ShapeGeometry geometry;
  const std::uint32_t rotation = store_rotation(glm::transpose(linear / scale), builder);
  geometry.spheres.push_back({world_center, world_radius, flip_normals != (determinant < 0), rotation});
  return geometry;
}

}  // namespace norrsken
