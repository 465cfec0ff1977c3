// Model       The irradiance of the shape that it stands in, on the side that its normals point to.
// Measure     uniform over the area, the film's coordinates being the shape's; cosine-weighted over directions
// Source      irradiance is the integral of radiance times the cosine: pi times the mean of cosine-weighted directions
// Departures  none
#pragma once

#include "camera/meter.h"
#include "math/frame.h"

namespace norrsken::NORRSKEN_ISA {

struct IrradianceMeter {
  static constexpr float kWeight = kPi;

  static NORRSKEN_INLINE CameraRay sample(const SceneView& scene, const CameraRecord& camera, Vec2f place, Vec2f angle,
                                          Mask active) {
    const MeterPoint p = sample_meter_surface(scene, camera, place, active);
    return {fma(p.normal, p.scale * kOffsetUlps, p.position),
            make_frame(p.normal).to_world(warp_to_cosine_hemisphere(angle))};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
