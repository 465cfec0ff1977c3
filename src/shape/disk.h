// Model       The disk x^2 + y^2 <= 1 of the plane z = 0, facing +z.
// Parameters  none: the place says the rest
// Measure     uniform over the area
// Source      Sampling: Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997.
//             Parameterisation: Mitsuba 3, shape `disk`: u is the radius, v the angle in turns
// Departures  none. As in Mitsuba dp_dv has unit length: it is not multiplied with the circumference.
#pragma once

#include "math/special.h"
#include "shape/shape.h"

namespace norrsken::NORRSKEN_ISA {

struct DiskShape {
  static NORRSKEN_INLINE LocalHit intersect(const Vec3f& o, const Vec3f& d, Float t_max) {
    // A ray in the disk's plane gives an infinity or no number, which no comparison below accepts.
    const Float t = -o.z / d.z;
    const Float x = fma(d.x, t, o.x), y = fma(d.y, t, o.y);
    return {t, (t > 0.0f) & (t < t_max) & (fma(x, x, y * y) <= 1.0f)};
  }

  static NORRSKEN_INLINE LocalSurface surface_at(const Vec3f& p) {
    const Float zero(0.0f), one(1.0f);
    const Float r = sqrt(fma(p.x, p.x, p.y * p.y));
    const Mask centre = !(r > zero);
    const Float inv = one / r;
    const Float cos_phi = select(centre, one, p.x * inv), sin_phi = select(centre, zero, p.y * inv);
    const Float turn = atan2(p.y, p.x) * Float(0.5f * kInvPi);
    return {{p.x, p.y, zero},
            {zero, zero, one},
            {r, select(turn < zero, turn + one, turn)},
            {cos_phi, sin_phi, zero},
            {-sin_phi, cos_phi, zero}};
  }

  static NORRSKEN_INLINE LocalPoint sample(Vec2f u) {
    const Vec2f p = warp_to_disk(u);
    const Float zero(0.0f);
    return {{p.x, p.y, zero}, {zero, zero, 1.0f}};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
