// Model       A sensor infinitely far away, that all rays of one direction come to: the mean radiance that leaves the scene,
//             a shape or a point in that direction.
// Measure     uniform over the area of the target; of the whole scene over the disk across a sphere around it
// Source      Mitsuba 3's documentation of its `distant` sensor
// Departures  none
#pragma once

#include "camera/meter.h"
#include "math/frame.h"

namespace norrsken::NORRSKEN_ISA {

struct Distant {
  static constexpr float kWeight = 1;

  static NORRSKEN_INLINE CameraRay sample(const SceneView& scene, const CameraRecord& camera, Vec2f, Vec2f angle,
                                          Mask active) {
    const Vec3f direction = broadcast(camera.forward), center = broadcast(scene.center);
    Vec3f target = broadcast(camera.origin);
    if (camera.piece_count == kWholeScene) {
      const Vec2f disk = warp_to_disk(angle);
      const Frame across = make_frame(direction);
      target = fma(across.s, disk.x * Float(scene.radius), fma(across.t, disk.y * Float(scene.radius), center));
    } else if (camera.piece_count != 0) {
      target = sample_meter_surface(scene, camera, angle, active).position;
    }
    // From before all that there is.
    const Float before = dot(target - center, direction) + Float(1.01f * scene.radius);
    return {fma(direction, -before, target), direction};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
