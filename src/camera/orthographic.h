// Model       Orthographic camera: all rays are parallel.
// Parameters  near_clip and far_clip (scene units along the axis), to_world, which may scale; compiled into the
//             CameraRecord: base + px du + py dv is the film position's point on the near plane
// Measure     one ray per film position; importance is constant over the film
// Source      the usual
// Departures  none
#pragma once

#include "camera/camera.h"

namespace norrsken::NORRSKEN_ISA {

struct Orthographic {
  static constexpr bool kUsesLens = false;

  static NORRSKEN_INLINE CameraRay sample(const CameraRecord& camera, Float px, Float py, Vec2f) {
    return {film_point(camera, px, py), broadcast(camera.forward)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
