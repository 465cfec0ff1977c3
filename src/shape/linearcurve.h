// Model       Chains of straight segments between control points with a radius each: the surface of a ball that moves and
//             swells evenly along every segment, so that joints and ends are round. Normals point outwards, and rays from
//             inside pass: the inside is never hit.
// Parameters  none: the table has the control points
// Measure     not sampled: as a light, only rays find it
// Source      The ball that touches the surface in a point: Han, Wald, Usher, Wu, Wang, Pascucci, Hansen, Johnson, "Ray
//             Tracing Generalized Tube Primitives: Method and Applications", Computer Graphics Forum 38(3), 2019: the
//             balls' envelope is a cone, whose normals n have n . p' = -r'.
//             Parameterisation: Mitsuba 3, shape `linearcurve`: u is the angle in turns, v goes through all segments
// Departures  none
#pragma once

#include "shape/curve.h"

namespace norrsken::NORRSKEN_ISA {

struct LinearCurveShape {
  static NORRSKEN_INLINE LocalSurface surface_at(const ElementReader& table, const Vec3f& p) {
    const Float zero(0.0f), one(1.0f);
    const CurveSegment<2> s(table, p);
    const Vec3f axis = s.point[1] - s.point[0];
    const Float swell = s.radius[1] - s.radius[0];
    // With (p - c(t)) . axis = -r(t) swell for the ball around c(t) that touches the surface in p. Of two balls of which
    // one is inside the other, only the larger is seen.
    const Float length2 = dot(axis, axis);
    const Float slope = length2 - swell * swell;
    const Float inside = select(swell > zero, one, zero);
    const Float touching = fms(s.radius[0], swell, dot(s.point[0], axis)) / slope;
    const Float t = select(slope > zero, min(max(touching, zero), one), inside);
    const Vec3f center = fma(axis, t, s.point[0]);
    const Float radius = fma(swell, t, s.radius[0]);

    const Vec3f n = normalize(-center);
    const CurveFrame frame(axis * (one / sqrt(length2)));
    LocalSurface surface{fma(n, radius, center) + p, n, {frame.turn(n), (s.first_v + t) / s.segments}, {}, {}};
    surface.dp_du = cross(frame.tangent, n) * (radius * Float(2.0f * kPi));
    surface.dp_dv = fma(n, swell, axis) * s.segments;
    surface.scale = s.size();
    return surface;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
