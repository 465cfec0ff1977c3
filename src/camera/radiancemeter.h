// Model       The radiance along one ray.
// Measure     all samples are of the same ray
// Source      none needed
// Departures  films of any size; every pixel measures the same
#pragma once

#include "camera/meter.h"

namespace norrsken::NORRSKEN_ISA {

struct RadianceMeter {
  static constexpr float kWeight = 1;

  static NORRSKEN_INLINE CameraRay sample(const SceneView&, const CameraRecord& camera, Vec2f, Vec2f, Mask) {
    return {broadcast(camera.origin), broadcast(camera.forward)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
