// Model       Two values in squares of half a unit of texture space.
// Source      none needed
// Departures  none
#pragma once

#include "texture/texture.h"

namespace norrsken::NORRSKEN_ISA {

struct Checkerboard {
  struct Stored {
    static constexpr TextureKind kKind = TextureKind::checkerboard;
    ToUvSlots to_uv;
    ColorSlot color0, color1;
  };

  static NORRSKEN_INLINE Color evaluate(const SceneView& scene, UInt offset, const TexturePoint& point, Mask active) {
    const Vec2f uv = to_uv(scene, offset, point.uv, active);
    // color0 where both coordinates are in the same half of their unit.
    const Mask right = uv.x - floor(uv.x) > 0.5f, upper = uv.y - floor(uv.y) > 0.5f;
    const Color color0 = gather_color_or_texture(scene, &Stored::color0, offset, point, active);
    const Color color1 = gather_color_or_texture(scene, &Stored::color1, offset, point, active);
    return select(right ^ upper, color1, color0);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
