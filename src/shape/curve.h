// What curves share: the table that their host files write, and the angle around them.
//
// A curve shape is any number of curves, each a chain of segments; segments are its elements. The table has the number of
// segments, for each segment the number of its first control point, then the control points: x, y, z, radius.
#pragma once

#include "math/special.h"
#include "shape/shape.h"

namespace norrsken::NORRSKEN_ISA {

/// The control points of one segment, told from a point next to it: differences of coordinates that are nearly equal are
/// exact, so that what is computed of them is as precise far from the origin as near it.
template <int N>
struct CurveSegment {
  Vec3f point[N];
  Float radius[N];
  Float first_v;   ///< v where the segment begins, in segments; it ends at 1 more
  Float segments;  ///< of the whole shape

  NORRSKEN_INLINE CurveSegment(const ElementReader& table, const Vec3f& p) {
    const UInt count = table.word(0u);
    const UInt first = count + 1u + table.word(table.element + 1u) * 4u;
    for (std::uint32_t k = 0; k < N; ++k) {
      const UInt at = first + UInt(4 * k);
      point[k] = Vec3f{table.number(at), table.number(at + 1u), table.number(at + 2u)} - p;
      radius[k] = table.number(at + 3u);
    }
    first_v = to_float(table.element);
    segments = to_float(count);
  }

  /// What rounding near the segment is relative to, whatever its place: the sizes that take part.
  NORRSKEN_INLINE Float size() const {
    Float size(0.0f);
    for (int k = 0; k < N; ++k) size = max(size, largest(point[k]) + abs(radius[k]));
    return size;
  }
};

/// The axes of the angle around a curve, across its unit tangent: u = 0 is along `start`, u = 1/4 along `quarter`.
/// Source: Mitsuba 3, shape `bsplinecurve`: `quarter` is the z axis, without its part along the tangent; y where the
/// curve is upright.
struct CurveFrame {
  Vec3f tangent, start, quarter;
  Float inv_across;  ///< one over the tangent's part across z; 0 where the curve is upright

  explicit NORRSKEN_INLINE CurveFrame(const Vec3f& unit_tangent) : tangent(unit_tangent) {
    const Float zero(0.0f), one(1.0f);
    const Vec3f& t = tangent;
    const Float across2 = fma(t.x, t.x, t.y * t.y);
    // Where the tangent's z rounds to 1.
    const Mask upright = across2 < 0x1p-24f;
    inv_across = select(upright, zero, one / sqrt(across2));
    quarter = select(upright, Vec3f{zero, one, zero},
                     Vec3f{-t.x * t.z * inv_across, -t.y * t.z * inv_across, across2 * inv_across});
    start = cross(quarter, t);
  }

  /// The angle of a direction in turns, 0 to 1.
  NORRSKEN_INLINE Float turn(const Vec3f& direction) const {
    const Float turn = atan2(dot(quarter, direction), dot(start, direction)) * Float(0.5f * kInvPi);
    return select(turn < 0.0f, turn + 1.0f, turn);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
