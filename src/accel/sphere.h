// Ray and sphere, geometrically: the closest approach to the centre, then Pythagoras (Akenine-Möller et al.,
// "Real-Time Rendering", ray/sphere intersection, geometric solution).
//
// Departure: the distance of the ray from the centre is the length of the rejected vector l - (l.d) d instead of
// sqrt(l.l - (l.d)^2), which cancels for small or far spheres (Haines, Günther, Akenine-Möller, "Precision
// Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019).
#pragma once

#include "accel/hit.h"
#include "tables/accel_tables.h"

namespace norrsken::NORRSKEN_ISA {

struct SphereCrossing {
  Float t0, t1;  ///< entry and exit
  Mask crosses;
};

/// `d` is a unit vector.
NORRSKEN_INLINE SphereCrossing cross_sphere(const float* center, float radius, const Vec3f& o, const Vec3f& d) {
  const Vec3f l = broadcast(center) - o;
  const Float tca = dot(l, d);
  const Vec3f rejected = l - d * tca;
  const Float gap =
      fnma(rejected.x, rejected.x, fnma(rejected.y, rejected.y, fnma(rejected.z, rejected.z, Float(radius * radius))));
  const Float thc = sqrt(max(gap, 0.0f));
  return {tca - thc, tca + thc, gap > 0.0f};
}

NORRSKEN_INLINE void closest_sphere(const SphereRecord& sphere, const Vec3f& o, const Vec3f& d, ClosestHit& hit) {
  const SphereCrossing c = cross_sphere(sphere.center, sphere.radius, o, d);
  const Mask inside = !(c.t0 > 0.0f);
  const Float t = select(inside, c.t1, c.t0);
  const Mask closer = c.crosses & (t > 0.0f) & (t < hit.t);
  const UInt side = select(inside, UInt(kBackSide), UInt(0u)) ^ UInt(sphere.back_flip);
  hit.t = select(closer, t, hit.t);
  hit.primitive_side = select(closer, side | UInt(sphere.primitive), hit.primitive_side);
}

NORRSKEN_INLINE Mask occluded_by_sphere(const SphereRecord& sphere, const Vec3f& o, const Vec3f& d, Float t_max) {
  const SphereCrossing c = cross_sphere(sphere.center, sphere.radius, o, d);
  const Mask inside = !(c.t0 > 0.0f);
  const Float t = select(inside, c.t1, c.t0);
  return c.crosses & (t > 0.0f) & (t < t_max);
}

}  // namespace norrsken::NORRSKEN_ISA
