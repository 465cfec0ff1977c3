// Model       Perspective camera with a thin lens: what lies in the plane of focus is sharp.
// Parameters  those of the pinhole camera, aperture_radius and focus_distance (scene units); compiled into the
//             CameraRecord: base + px du + py dv is the film position's point in the plane of focus, seen from
//             `origin`, and lens_x and lens_y span the lens
// Measure     uniform over the film and over the lens
// Source      Kolb, Mitchell and Hanrahan, "A Realistic Camera Model for Computer Graphics", 1995, section 3.1: all rays
//             from one film position through an ideal lens meet in one point of the plane of focus
// Departures  none
#pragma once

#include "camera/camera.h"
#include "camera/connect.h"

namespace norrsken::NORRSKEN_ISA {

struct ThinLens {
  static constexpr bool kUsesLens = true;

  static NORRSKEN_INLINE CameraRay sample(const CameraRecord& camera, Float px, Float py, Vec2f lens) {
    const Vec3f on_lens = lens_point(camera, lens);
    const Vec3f direction = normalize(film_point(camera, px, py) - on_lens);
    return start_at_near_plane(camera, broadcast(camera.origin) + on_lens, direction);
  }

  static NORRSKEN_INLINE CameraConnection connect(const CameraRecord& camera, const Vec3f& point, Vec2f lens) {
    return connect_through(camera, lens_point(camera, lens), point);
  }

 private:
  static NORRSKEN_INLINE Vec3f lens_point(const CameraRecord& camera, Vec2f lens) {
    const Vec2f disk = warp_to_disk(lens);
    return fma(broadcast(camera.lens_x), disk.x, broadcast(camera.lens_y) * disk.y);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
