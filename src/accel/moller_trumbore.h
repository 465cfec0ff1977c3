// Ray and triangle: the reference intersector, which the faster ones are held against.
// Source: Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997. In the words of the course
// report that this renderer grew from (its equations 1 to 9): T = p_s - v0, E1 = v1 - v0, E2 = v2 - v0, P = D x E2,
// Q = T x E1, and (t, u, v) = (Q.E2, P.T, Q.D) / (P.E1).
#pragma once

#include "accel/hit.h"

namespace norrsken::NORRSKEN_ISA {

struct TriangleCrossing {
  Float t;
  Mask inside;  ///< of the triangle; t may have any sign
  Mask back;    ///< seen from the side where the corners run clockwise
};

NORRSKEN_INLINE TriangleCrossing cross_triangle(const float* v0, const float* v1, const float* v2, const Vec3f& o,
                                                const Vec3f& d) {
  const Vec3f e1{Float(v1[0] - v0[0]), Float(v1[1] - v0[1]), Float(v1[2] - v0[2])};
  const Vec3f e2{Float(v2[0] - v0[0]), Float(v2[1] - v0[1]), Float(v2[2] - v0[2])};
  const Vec3f p = cross(d, e2);
  const Float det = dot(p, e1);
  const Float inv = 1.0f / det;
  const Vec3f t_vec = o - broadcast(v0);
  const Float u = inv * dot(p, t_vec);
  const Vec3f q = cross(t_vec, e1);
  const Float v = inv * dot(q, d);
  const Float t = inv * dot(q, e2);
  // A few ulps of overlap, so that neighbours leave no gap between them.
  const Float slack(-0x1p-20f);
  return {t, (u >= slack) & (v >= slack) & (u + v <= Float(1.0f + 0x1p-20f)), det < 0.0f};
}

}  // namespace norrsken::NORRSKEN_ISA
