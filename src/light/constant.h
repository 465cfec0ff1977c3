// Model       The same radiance from everywhere around the scene.
// Parameters  radiance (linear sRGB, W / (m^2 sr))
// Measure     pdf_sa: uniform over the sphere of directions
// Source      none needed
// Departures  none
#pragma once

#include "light/light.h"

namespace norrsken::NORRSKEN_ISA {

/// A point of the unit sphere, uniformly.
NORRSKEN_INLINE Vec3f warp_to_sphere(Vec2f u) {
  const Float z = fnma(Float(2.0f), u.x, Float(1.0f));
  const Float r = sqrt(max(fnma(z, z, Float(1.0f)), Float(0.0f)));
  const SinCos phi = sin_cos_turns(u.y);
  return {r * phi.cos, r * phi.sin, z};
}

struct ConstantEnvironment {
  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f u,
                                            Mask active) {
    const Vec3f direction = warp_to_sphere(u);
    return {fma(direction, Float(2.0f * scene.radius), reference), Float(0.25f * kInvPi), light.emission, active};
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light&, const Vec3f&, const Vec3f&, Float, Mask) {
    return Float(0.25f * kInvPi);
  }

  static NORRSKEN_INLINE Vec3f radiance(const SceneView&, const Light& light, const Vec3f&, Mask) {
    return light.emission;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
