// The sensor of a scene that has none: Mitsuba's convention, so that such a scene shows the same picture.
// Source: Mitsuba 3 (src/render/scene.cpp), in its versions before those that refuse such scenes.
#pragma once

#include <glm/vec3.hpp>

#include "scene/description.h"

namespace norrsken {

inline constexpr double kDefaultFieldOfView = 45;  ///< degrees, along x

/// A perspective sensor at the origin, along +z, with the film and the sampler that are the defaults.
Node make_default_sensor(const SourceLocation& location);

/// Places it on the box's lower side in z, so far away that the longest of the box's sides fills the field of view.
void look_at_box(Node& sensor, const glm::dvec3& lower, const glm::dvec3& upper);

}  // namespace norrsken
