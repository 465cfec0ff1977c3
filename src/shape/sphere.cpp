// sphere: centre and radius.
//
// u turns around the local z axis, v goes from the pole at +z to that at -z. A mirroring `to_world` turns the normal around, as in Mitsuba.
// Departures: Mitsuba warns of a scale that differs between directions and renders a sphere; here it is an error.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "compile/shapes.h"
#include "shape/analytic_host.h"

namespace norrsken {
namespace {

constexpr PointParameter kCenter{.name = "center", .unit = "scene units"};
constexpr NumberParameter kRadius{.name = "radius", .fallback = 1, .range = {0, kMaxCoordinate}, .unit = "scene units"};
constexpr TransformParameter kToWorld{.name = "to_world",
                                      .text =
                                          "applied to the sphere of that centre and radius; its scale must be the same "
                                          "in all directions; up to a percent that it differs by is left out",
                                      .flat = Flat::yes};
constexpr BooleanParameter kFlipNormals{.name = "flip_normals", .text = "the normal points to the centre"};

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
std::uint32_t store_rotation(const glm::dmat3& object_from_world, Shapes& shapes) {
  const auto is_rounding = [](double difference) { return std::abs(difference) < 1e-12; };
  bool rotated = false;
  for (int i = 0; i < 9; ++i) rotated |= !is_rounding(object_from_world[i / 3][i % 3] - (i % 4 == 0));
  if (!rotated) return kNone;
  float rows[9];
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rows[3 * row + column] = static_cast<float>(object_from_world[column][row]);
  }
  return shapes.store_rotation(rows);
}

}  // namespace

std::optional<ShapeGeometry> compile_shape_sphere(Parameters& p, Shapes& shapes) {
  const glm::dvec3 center = p.read(kCenter);
  const double radius = p.read(kRadius);
  const glm::dmat4 to_world = p.read(kToWorld);
  const bool flip_normals = p.read(kFlipNormals);

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
      p.error(kToWorld.name, "the sphere is placed too far away or made too large",
              fmt::format("coordinates up to {:g}", kMaxCoordinate));
      return std::nullopt;
    }
  }
  if (!std::isnormal(static_cast<float>(world_radius))) {
    return nothing_to_draw(p, "radius", world_radius);
  }
  shapes.describe(p.node(), fmt::format("radius {:.6g}", world_radius));
  ShapeGeometry geometry;
  const std::uint32_t rotation = store_rotation(glm::transpose(linear / scale), shapes);
  geometry.spheres.push_back({world_center, world_radius, flip_normals != (determinant < 0), rotation});
  return geometry;
}

}  // namespace norrsken
