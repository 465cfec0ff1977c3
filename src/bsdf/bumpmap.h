// Model       The BSDF inside, with the shading normal of the surface moved along its normals by a texture.
// Measure     that of the BSDF inside
// Source      Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978: the derivatives of the moved surface without the
//             term in the change of the normal
// Departures  a map inside of a bump map works in the surface's own frame; in Mitsuba 3.9 the tangents there are mixed of
//             world and local directions, which is the same only where the surface's frame is the world's
#pragma once

#include "bsdf/resolved.h"

namespace norrsken::NORRSKEN_ISA {

struct BumpMap {
  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::bumpmap;
    PerturbedSlots around;
    float scale;
    TextureWord texture;
  };

  static NORRSKEN_INLINE Vec3f normal(const ParameterReader& p, const Unperturbed& s) {
    const UInt texture = p.get(&Stored::texture) & UInt(kTextureOffsetMask);
    const Vec2f slope = Bitmap::gradient(p.scene, texture, p.point, p.active);
    const Float scale = p.get(&Stored::scale);
    const auto moved = [&](const Vec3f& tangent, Float height) {
      return fma(s.frame.n, fms(height, scale, dot(s.frame.n, tangent)), tangent);
    };
    const Vec3f n = cross(moved(s.dp_du, slope.x), moved(s.dp_dv, slope.y));
    return s.frame.to_local(n * copysign(1.0f, dot(n, s.normal)));
  }
};

}  // namespace norrsken::NORRSKEN_ISA
