// Model       The cylinder x^2 + y^2 = 1, 0 <= z <= 1, open at both ends; its normals point away from the axis.
// Parameters  none: the place has the radius and the length
// Measure     uniform over the area
// Source      Intersection: the quadratic's discriminant as |d|^2 - (o x d)^2 in the plane, by Lagrange's identity, which
//             keeps what b^2 - 4ac cancels for far origins; the cross product by Kahan's difference of products
//             (Jeannerod, Louvet, Muller, "Further analysis of Kahan's algorithm for the accurate computation of 2x2
//             determinants", 2013, algorithm 1).
//             Parameterisation: Mitsuba 3, shape `cylinder`: u is the angle in turns, v goes along the axis
// Departures  none
#pragma once

#include "math/special.h"
#include "shape/shape.h"

namespace norrsken::NORRSKEN_ISA {

struct CylinderShape {
  static NORRSKEN_INLINE LocalHit intersect(const Vec3f& o, const Vec3f& d, Float t_max) {
    const Float zero(0.0f), one(1.0f);
    const Float a = fma(d.x, d.x, d.y * d.y);
    const Float product = o.y * d.x;
    const Float moment = fms(o.x, d.y, product) + fnma(o.y, d.x, product);
    const Float discriminant = fnma(moment, moment, a);
    const Float inv = one / a;
    const Float middle = -fma(o.x, d.x, o.y * d.y) * inv;
    const Float half_chord = sqrt(max(discriminant, zero)) * inv;
    const auto within = [&](Float t) {
      const Float z = fma(d.z, t, o.z);
      return (t > zero) & (t < t_max) & (z >= zero) & (z <= one);
    };
    const Float t0 = middle - half_chord, t1 = middle + half_chord;
    const Mask first = within(t0);
    // A ray along the axis has a = 0: its infinities and not-a-numbers fail every comparison above.
    return {select(first, t0, t1), (discriminant > zero) & (first | within(t1))};
  }

  static NORRSKEN_INLINE LocalSurface surface_at(const Vec3f& p) {
    const Float zero(0.0f), one(1.0f), two_pi(2.0f * kPi);
    const Float inv = one / sqrt(fma(p.x, p.x, p.y * p.y));
    const Vec3f n{p.x * inv, p.y * inv, zero};
    const Float turn = atan2(n.y, n.x) * Float(0.5f * kInvPi);
    return {{n.x, n.y, p.z},
            n,
            {select(turn < zero, turn + one, turn), p.z},
            {-n.y * two_pi, n.x * two_pi, zero},
            {zero, zero, one}};
  }

  static NORRSKEN_INLINE LocalPoint sample(Vec2f u) {
    const SinCos phi = sin_cos_turns(u.y);
    const Vec3f n{phi.cos, phi.sin, 0.0f};
    return {{n.x, n.y, u.x}, n};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
