// What models without camera and light are looked at in.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "scene/description.h"

namespace norrsken {

struct Bounds {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};

  bool is_empty() const { return !(lower.x <= upper.x); }
  void add(const glm::dvec3& point);
  /// The corners of the other box, moved.
  void add(const Bounds& other, const glm::dmat4& to_world);
  glm::dvec3 center() const { return (lower + upper) / 2.0; }
  glm::dvec3 sides() const { return upper - lower; }
};

Bounds bounds_of(const Mesh& mesh);

/// A camera that sees all of the box, a little from above and from the right of its front, which is towards +z; flat things
/// from right in front of them. y is up.
Node sensor_around(const Bounds& bounds, const SourceLocation& place);
/// A film of that shape, and a sampler.
void add_film(Node& sensor, double aspect, const SourceLocation& place);

/// Grey light from all around, brighter from above, with a soft lamp above on the left. A white surface that faces it is
/// about 1 bright.
Node studio_sky(const SourceLocation& place);
/// What a note says of it.
inline constexpr const char* kStudioText = "a grey sky with a soft lamp above on the left";

/// A wide grey floor under the box.
Node studio_floor(const Bounds& bounds, const SourceLocation& place);

/// Path tracing as deep as glass needs it.
Node studio_integrator(const SourceLocation& place);

}  // namespace norrsken
