// Model       Pinhole camera.
// Parameters  fov (degrees), fov_axis, near_clip and far_clip (scene units along the axis), to_world; compiled into the
//             CameraRecord: a film position (px, py) looks along base + px du + py dv
// Measure     one ray per film position; importance is constant over the film
// Source      the usual
// Departures  none
#pragma once

#include "math/vec3.h"
#include "tables/scene_tables.h"

namespace norrsken::NORRSKEN_ISA {

struct CameraRay {
  Vec3f origin;     ///< on the near plane
  Vec3f direction;  ///< unit
};

/// `px` and `py` in pixels from the film's top left corner.
NORRSKEN_INLINE CameraRay sample_perspective(const CameraRecord& camera, Float px, Float py) {
  const Vec3f d = normalize(fma(broadcast(camera.du), px, fma(broadcast(camera.dv), py, broadcast(camera.base))));
  const Float to_near_plane = Float(camera.near_clip) / dot(d, broadcast(camera.forward));
  return {fma(d, to_near_plane, broadcast(camera.origin)), d};
}

/// How far along a ray from the near plane the far plane is.
NORRSKEN_INLINE Float distance_to_far_plane(const CameraRecord& camera, const Vec3f& direction) {
  return Float(camera.far_clip - camera.near_clip) / dot(direction, broadcast(camera.forward));
}

}  // namespace norrsken::NORRSKEN_ISA
