// From the unit square to where samples are wanted, each warp beside its density.
#pragma once

#include "math/trig.h"
#include "math/vec3.h"

namespace norrsken::NORRSKEN_ISA {

inline constexpr float kPi = 3.14159265358979f;
inline constexpr float kInvPi = 0.318309886183791f;

struct Vec2f {
  Float x, y;
};
NORRSKEN_INLINE Vec2f select(Mask m, const Vec2f& a, const Vec2f& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y)};
}

/// Area-preserving and continuous map of the unit square to the unit disk.
/// Source: Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997.
NORRSKEN_INLINE Vec2f warp_to_disk(Vec2f u) {
  const Float a = fma(u.x, 2.0f, -1.0f), b = fma(u.y, 2.0f, -1.0f);
  const Mask x_major = abs(a) > abs(b);
  const Float radius = select(x_major, a, b), minor = select(x_major, b, a);
  // At the centre both are zero: 0/0 is replaced by an angle of zero.
  const Float ratio = minor / select(radius == 0.0f, 1.0f, radius);
  const SinCos q = sin_cos_quarter(ratio * Float(kPi / 4));
  return {radius * select(x_major, q.cos, q.sin), radius * select(x_major, q.sin, q.cos)};
}

/// Directions with density cos(theta) / pi over solid angle: a point of the disk, projected up (Malley).
NORRSKEN_INLINE Vec3f warp_to_cosine_hemisphere(Vec2f u) {
  const Vec2f d = warp_to_disk(u);
  const Float z2 = fnma(d.x, d.x, fnma(d.y, d.y, 1.0f));
  return {d.x, d.y, sqrt(max(z2, 0.0f))};
}
NORRSKEN_INLINE Float cosine_hemisphere_pdf_sa(Float cos_theta) { return max(cos_theta, 0.0f) * kInvPi; }

/// A point of the unit sphere, uniformly.
NORRSKEN_INLINE Vec3f warp_to_sphere(Vec2f u) {
  const Float z = fnma(2.0f, u.x, 1.0f);
  const Float r = sqrt(max(fnma(z, z, 1.0f), 0.0f));
  const SinCos phi = sin_cos_turns(u.y);
  return {r * phi.cos, r * phi.sin, z};
}

/// Barycentric (b1, b2) of a uniform point of a triangle, by folding the square's upper half onto the lower one's
/// diagonals. Source: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
NORRSKEN_INLINE Vec2f warp_to_triangle(Vec2f u) {
  const Mask upper = u.y > u.x;
  const Float half_min = select(upper, u.x, u.y) * 0.5f;
  const Float rest = select(upper, u.y, u.x) - half_min;
  return {select(upper, half_min, rest), select(upper, rest, half_min)};
}

/// Directions within the cone cos(theta) >= 1 - one_minus_cos around z, uniform over its solid angle.
NORRSKEN_INLINE Vec3f warp_to_cone(Vec2f u, Float one_minus_cos) {
  const Float h = u.x * one_minus_cos;  // 1 - cos(theta), kept small to stay precise for narrow cones
  const Float sin_theta = sqrt(max(h * (2.0f - h), 0.0f));
  const SinCos phi = sin_cos_turns(u.y);
  return {sin_theta * phi.cos, sin_theta * phi.sin, 1.0f - h};
}
NORRSKEN_INLINE Float cone_pdf_sa(Float one_minus_cos) { return Float(1.0f / (2.0f * kPi)) / one_minus_cos; }

/// pdf over area to pdf over solid angle, seen from `distance2` away under `cos_at_surface`.
NORRSKEN_INLINE Float pdf_sa_from_pdf_area(Float pdf_area, Float distance2, Float cos_at_surface) {
  return pdf_area * distance2 / cos_at_surface;
}

}  // namespace norrsken::NORRSKEN_ISA
