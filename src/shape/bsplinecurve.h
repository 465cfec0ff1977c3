// Model       Uniform cubic B-splines through space with a radius at each control point, a B-spline of its own: the
//             surface of a circle that moves along the curve, always across it; open at the ends. Normals point outwards,
//             and rays from inside pass: the inside is never hit.
// Parameters  none: the table has the control points
// Measure     not sampled: as a light, only rays find it
// Source      Where p is on the curve: the root of (p - c(t)) . c'(t), the condition that the circle through p is across
//             the curve (Embree, RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE), bracketed and refined by Newton's method. The
//             normal is the gradient of |p - c(t(p))|^2 - r(t(p))^2, with t(p) differentiated by that condition.
//             Parameterisation: Mitsuba 3, shape `bsplinecurve`: u is the angle in turns, v goes through all segments
// Departures  dp_dv keeps u, the angle that textures see; Mitsuba's keeps the angle to the curve's principal normal. They
//             differ along dp_du.
#pragma once

#include "shape/curve.h"

namespace norrsken::NORRSKEN_ISA {

struct BsplineCurveShape {
  static NORRSKEN_INLINE LocalSurface surface_at(const ElementReader& table, const Vec3f& p) {
    const Float zero(0.0f), one(1.0f);
    const CurveSegment<4> s(table, p);
    const Curve curve(s);
    const Float t = parameter(curve);

    const Vec3f center = curve.center(t), along = curve.along(t), bend = curve.bend(t);
    const Float radius = curve.radius(t), swell = curve.swell(t);
    // Control points that coincide can make a curve begin or end without a direction of its own.
    const Float speed2 = dot(along, along);
    const Vec3f chord = s.point[3] - s.point[0];
    const Float inv_speed = one / sqrt(select(speed2 > zero, speed2, dot(chord, chord)));
    const CurveFrame frame(select(speed2 > zero, along, chord) * inv_speed);
    const Float off2 = dot(center, center);
    const Vec3f e = select(off2 > zero, center * (-1.0f / sqrt(off2)), frame.start);

    const Float curvature = radius * dot(e, bend);
    const Vec3f gradient = fma(e, speed2 - curvature, along * -swell);
    const Float gradient2 = dot(gradient, gradient);
    const Vec3f n = select(gradient2 > zero, gradient * (one / sqrt(gradient2)), e);

    LocalSurface surface{fma(e, radius, center) + p, n, {frame.turn(e), (s.first_v + t) / s.segments}, {}, {}};
    const Vec3f around = cross(frame.tangent, e);
    surface.dp_du = around * (radius * Float(2.0f * kPi));
    // The axes of the angle turn with the tangent, and, since one of them stays below the z axis, around it.
    const Float twist = frame.tangent.z * frame.inv_across * inv_speed * dot(bend, frame.start);
    const Vec3f turned = fma(frame.tangent, -dot(e, bend) * inv_speed, around * twist);
    surface.dp_dv = (fma(e, swell, along) + turned * radius) * s.segments;
    // Embree's search is content with about 16 times the rounding of what it searches in, and rays that go on inwards from
    // closer than that would be stopped where they begin.
    surface.scale = s.size() * 16.0f;
    return surface;
  }

 private:
  /// The segment as a polynomial of t in [0, 1], told from p.
  struct Curve {
    Vec3f c[4];
    Float r[4];

    explicit NORRSKEN_INLINE Curve(const CurveSegment<4>& s) {
      const auto weigh = [](auto q0, auto q1, auto q2, auto q3, auto out) {
        const Float half(0.5f), sixth(1.0f / 6.0f), minus_two(-2.0f), three(3.0f), four(4.0f);
        out[0] = fma(q1, four, q0 + q2) * sixth;
        out[1] = (q2 - q0) * half;
        out[2] = fma(q1, minus_two, q0 + q2) * half;
        out[3] = fma(q1 - q2, three, q3 - q0) * sixth;
      };
      weigh(s.point[0], s.point[1], s.point[2], s.point[3], c);
      weigh(s.radius[0], s.radius[1], s.radius[2], s.radius[3], r);
    }

    NORRSKEN_INLINE Vec3f center(Float t) const { return fma(fma(fma(c[3], t, c[2]), t, c[1]), t, c[0]); }
    NORRSKEN_INLINE Vec3f along(Float t) const { return fma(fma(c[3], 3.0f * t, c[2] * 2.0f), t, c[1]); }
    NORRSKEN_INLINE Vec3f bend(Float t) const { return fma(c[3], 6.0f * t, c[2] * 2.0f); }
    NORRSKEN_INLINE Float radius(Float t) const {
      // Where the radius runs out, rounding could make it negative.
      return max(fma(fma(fma(r[3], t, r[2]), t, r[1]), t, r[0]), 0.0f);
    }
    NORRSKEN_INLINE Float swell(Float t) const { return fma(fma(r[3], 3.0f * t, r[2] * 2.0f), t, r[1]); }
    /// Half the derivative of the squared distance from p: 0 where p is across the curve.
    NORRSKEN_INLINE Float ahead(Float t) const { return dot(center(t), along(t)); }
    /// How far p is off the circle around c(t), if it is across the curve there.
    NORRSKEN_INLINE Float off(Float t) const {
      const Vec3f q = center(t);
      return abs(sqrt(dot(q, q)) - radius(t));
    }
  };

  /// Where along the segment p is.
  static NORRSKEN_INLINE Float parameter(const Curve& curve) {
    // A bent segment can be across p several times, but be around it by its radius only once. Eight steps tell apart
    // what a cubic can do within a segment.
    constexpr int kSteps = 8, kNewton = 6;
    const Float zero(0.0f), one(1.0f), step(1.0f / kSteps);
    Float lower = zero, upper = zero, t = zero, best = Float(__builtin_inff());
    const auto consider = [&](Mask candidate, Float from, Float to, Float guess, Float off) {
      const Mask better = candidate & (off < best);
      lower = select(better, from, lower), upper = select(better, to, upper);
      t = select(better, guess, t), best = select(better, off, best);
    };
    // p may be beyond an end by rounding.
    const auto consider_end = [&](Mask beyond, Float end, Float ahead) {
      const Vec3f along = curve.along(end);
      const Float speed2 = dot(along, along);
      const Float gap = select(speed2 > zero, abs(ahead) / sqrt(speed2), zero);
      consider(beyond, end, end, end, curve.off(end) + gap);
    };
    Float before = curve.ahead(zero);
    consider_end(before >= zero, zero, before);
    for (int k = 0; k < kSteps; ++k) {
      const Float from(static_cast<float>(k) / kSteps);
      const Float after = curve.ahead(from + step);
      const Mask between = (before < zero) ^ (after < zero);
      const Float guess = fma(step, before / (before - after), from);
      if (any(between)) consider(between, from, from + step, guess, curve.off(guess));
      before = after;
    }
    consider_end(before <= zero, one, before);

    const Mask falling = curve.ahead(lower) >= zero;
    for (int k = 0; k < kNewton; ++k) {
      const Vec3f q = curve.center(t), along = curve.along(t);
      const Float ahead = dot(q, along);
      const Mask root_above = (ahead < zero) ^ falling;
      lower = select(root_above, t, lower), upper = select(root_above, upper, t);
      const Float newton = t - ahead / (dot(along, along) + dot(q, curve.bend(t)));
      t = select((newton >= lower) & (newton <= upper), newton, (lower + upper) * 0.5f);
    }
    return t;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
