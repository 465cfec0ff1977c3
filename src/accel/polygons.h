// Merging coplanar triangles into convex polygons.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "tables/scene_tables.h"

namespace norrsken {

/// A convex polygon with its corners in order, counter-clockwise seen from the front.
struct ConvexPolygon {
  std::vector<glm::dvec3> corners;
  glm::dvec3 normal;            ///< unit
  double offset = 0;            ///< normal . p
  std::uint32_t primitive = 0;  ///< the first triangle that it is made of
};

/// The scene's triangles, merged where the result is convex and the surface is one: same shape, material and light, flat
/// shading, and what varies over it is one affine map of the polygon.
/// `variation`: at least so much varies over every surface.
std::vector<ConvexPolygon> merge_triangles(const SceneTables& scene, Variation variation = Variation::none);

/// Length scale of the scene: the largest absolute coordinate of its bounds, at least the smallest positive double.
double scene_scale(const SceneTables& scene);

/// Tolerance within which points count as coplanar or corners as one line, relative to the coordinates at hand: a large
/// ground elsewhere must not blur small things. Not to merge is always correct.
inline constexpr double kCoplanar = 1e-6;

/// The largest absolute coordinate.
double magnitude(const glm::dvec3& p);

/// Whether all of b's corners lie in a's plane, with the front on the same side.
bool coplanar(const ConvexPolygon& a, const ConvexPolygon& b);

}  // namespace norrsken
