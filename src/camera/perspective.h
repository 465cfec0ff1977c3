// Model       Pinhole camera.
// Parameters  fov (degrees), fov_axis, near_clip and far_clip (scene units along the axis), to_world; compiled into the
//             CameraRecord: a film position looks along base + px du + py dv from `origin`
// Measure     one ray per film position; importance is constant over the film
// Source      the usual
// Departures  none
#pragma once

#include "camera/camera.h"
#include "camera/connect.h"

namespace norrsken::NORRSKEN_ISA {

struct Perspective {
  static constexpr bool kUsesLens = false;

  static NORRSKEN_INLINE CameraRay sample(const CameraRecord& camera, Float px, Float py, Vec2f) {
    return start_at_near_plane(camera, broadcast(camera.origin), normalize(film_point(camera, px, py)));
  }

  static NORRSKEN_INLINE CameraConnection connect(const CameraRecord& camera, const Vec3f& point, Vec2f) {
    return connect_through(camera, {0.0f, 0.0f, 0.0f}, point);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
