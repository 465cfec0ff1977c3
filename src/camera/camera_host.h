// What sensors share on the host.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

inline constexpr double kFarthest = 8 * kMaxCoordinate;  ///< no two points are so far apart

/// Local axes of a sensor in the world: it looks along `forward`, +y is up and +x to the left.
struct CameraFrame {
  glm::dvec3 origin, left, up, forward;
};

inline constexpr TransformParameter kRigidToWorld{
    .name = "to_world", .text = "without scale; local +z is the direction of view, +y up and +x left"};

void store(float (&out)[3], const glm::dvec3& v);

/// near_clip and far_clip.
void read_clip_planes(Parameters& p, CameraRecord& camera);

/// to_world of a sensor that must not scale.
CameraFrame read_rigid_frame(Parameters& p);

/// Puts film position (px, py) at base + px du + py dv: the film's middle at `center`, 2 * half_width units wide.
/// Offsets are shares of the film's sides that what is in its middle moves by, left and up.
void span_film(CameraRecord& camera, const CameraFrame& frame, const FilmSettings& film, const glm::dvec3& center,
               double half_width, double offset_x, double offset_y);

}  // namespace norrsken
