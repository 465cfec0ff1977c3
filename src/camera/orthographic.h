// Model       Orthographic camera: all rays are parallel.
// Parameters  near_clip and far_clip (scene units along the axis), to_world, which may scale; compiled into the
//             CameraRecord: base + px du + py dv is the film position's point on the near plane
// Measure     one ray per film position; importance is constant over the film
// Source      the usual
// Departures  none
#pragma once

#include "camera/camera.h"
#include "camera/connect.h"

namespace norrsken::NORRSKEN_ISA {

struct Orthographic {
  static constexpr bool kUsesLens = false;

  static NORRSKEN_INLINE CameraRay sample(const CameraRecord& camera, Float px, Float py, Vec2f) {
    return {film_point(camera, px, py), broadcast(camera.forward)};
  }

  /// point = film_point(px, py) + forward t, solved for px, py and t: a transform may shear the film.
  static NORRSKEN_INLINE CameraConnection connect(const CameraRecord& camera, const Vec3f& point, Vec2f) {
    const Vec3f du = broadcast(camera.du), dv = broadcast(camera.dv), forward = broadcast(camera.forward);
    const Vec3f film_normal = cross(du, dv), q = point - broadcast(camera.base);
    const Float volume = dot(film_normal, forward);
    const Float t = dot(q, film_normal) / volume;
    // What a pixel covers, perpendicular to the rays, is the volume that it sweeps along a unit of them.
    return {fma(forward, -t, point),
            {dot(q, cross(dv, forward)) / volume, dot(q, cross(forward, du)) / volume},
            1.0f / abs(volume),
            between_clip_planes(camera, t + Float(camera.near_clip))};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
