// Model       Two values in squares of half a unit of texture space.
// Parameters  color0, color1 (linear sRGB or float, defaults 0.4 and 0.2), to_uv (transform, default identity)
// Source      none needed
// Departures  color0 and color1 are values, not textures in turn
#pragma once

#include "texture/texture.h"

namespace norrsken::NORRSKEN_ISA {

/// Stored: to_uv (6 floats), color0 (3), color1 (3).
struct Checkerboard {
  static NORRSKEN_INLINE Color evaluate(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const Vec2f uv = to_uv(scene, offset, point.uv, active);
    // color0 where both coordinates are in the same half of their unit.
    const Mask right = uv.x - floor(uv.x) > 0.5f, upper = uv.y - floor(uv.y) > 0.5f;
    const Color color0 = gather_color(scene.parameters + 6, offset, active);
    const Color color1 = gather_color(scene.parameters + 9, offset, active);
    return select(right ^ upper, color1, color0);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
