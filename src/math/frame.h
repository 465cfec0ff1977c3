// An orthonormal frame around a normal. Local z is the normal.
#pragma once

#include "math/vec3.h"

namespace norrsken::NORRSKEN_ISA {

struct Frame {
  Vec3f s, t, n;

  NORRSKEN_INLINE Vec3f to_local(const Vec3f& w) const { return {dot(s, w), dot(t, w), dot(n, w)}; }
  NORRSKEN_INLINE Vec3f to_world(const Vec3f& l) const { return fma(s, l.x, fma(t, l.y, n * l.z)); }
};

/// Source: Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin, "Building an Orthonormal Basis, Revisited",
/// JCGT 6(1), 2017, listing 3.
NORRSKEN_INLINE Frame make_frame(const Vec3f& n) {
  const Float sign = copysign(1.0f, n.z);
  const Float a = -1.0f / (sign + n.z);
  const Float b = n.x * n.y * a;
  return {{fma(sign * n.x, n.x * a, 1.0f), sign * b, -sign * n.x}, {b, fma(n.y * n.y, a, sign), -n.y}, n};
}

/// A frame whose s is the direction of `tangent` in the plane of `n` (a unit vector); any frame if there is none.
NORRSKEN_INLINE Frame frame_along(const Vec3f& n, const Vec3f& tangent) {
  const Vec3f flat = fma(n, -dot(n, tangent), tangent);
  const Float length2 = dot(flat, flat);
  const Mask found = length2 > 1e-12f * dot(tangent, tangent);
  const Frame other = make_frame(n);
  const Vec3f s = select(found, flat * (1.0f / sqrt(length2)), other.s);
  return {s, cross(n, s), n};
}

}  // namespace norrsken::NORRSKEN_ISA
