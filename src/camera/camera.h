// What a camera model (src/camera/NAME.h, listed in lists/camera.def) gives the kernels.
//
//   struct Model {
//     static constexpr bool kUsesLens;  // sample() looks at `lens`
//     // `px` and `py` in pixels from the top left corner of the whole film, `lens` in the unit square
//     static CameraRay sample(const CameraRecord&, Float px, Float py, Vec2f lens);
//     // where the camera sees a point through that place of the lens (src/camera/connect.h)
//     static CameraConnection connect(const CameraRecord&, const Vec3f& point, Vec2f lens);
//   };
//
// Measure: one ray per film position and lens position; every film position counts the same.
#pragma once

#include "math/warp.h"
#include "tables/meter_tables.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

struct CameraRay {
  Vec3f origin;     ///< on the near plane
  Vec3f direction;  ///< unit
};

/// The film position on the plane that the record's base, du and dv span.
NORRSKEN_INLINE Vec3f film_point(const CameraRecord& camera, Float px, Float py) {
  return fma(broadcast(camera.du), px, fma(broadcast(camera.dv), py, broadcast(camera.base)));
}

/// What a step along a ray is along the camera's axis. Sensors without an axis, whose rays go anywhere, have a `forward` of
/// zero, and planes that are infinitely far away.
NORRSKEN_INLINE Float axial_share(const CameraRecord& camera, const Vec3f& direction) {
  return max(abs(dot(direction, broadcast(camera.forward))), 1e-30f);
}

/// How far along a ray behind its beginning the camera is.
NORRSKEN_INLINE Float distance_to_near_plane(const CameraRecord& camera, const Vec3f& direction) {
  return Float(camera.near_clip) / axial_share(camera, direction);
}

/// The ray through `origin`, begun where it meets the near plane.
NORRSKEN_INLINE CameraRay start_at_near_plane(const CameraRecord& camera, const Vec3f& origin, const Vec3f& direction) {
  return {fma(direction, distance_to_near_plane(camera, direction), origin), direction};
}

/// How far along a ray from the near plane the far plane is.
NORRSKEN_INLINE Float distance_to_far_plane(const CameraRecord& camera, const Vec3f& direction) {
  return Float(camera.far_clip - camera.near_clip) / axial_share(camera, direction);
}

}  // namespace norrsken::NORRSKEN_ISA
