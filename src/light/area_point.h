// What lights on surfaces share: a point of their area, as it is seen from elsewhere and as paths begin at it.
#pragma once

#include "light/emit.h"

namespace norrsken::NORRSKEN_ISA {

/// Uniform over the area of a light.
struct AreaPoint {
  Vec3f point, normal;
  Color radiance;
  Float scale;   ///< what rounding is relative to
  Mask sampled;  ///< false: the light is of a shape that nothing samples
};

/// Off the surface by the rounding bound.
NORRSKEN_INLINE Vec3f origin_at(const AreaPoint& p) { return fma(p.normal, p.scale * kOffsetUlps, p.point); }

NORRSKEN_INLINE LightSample seen_from(const Vec3f& reference, const AreaPoint& p, Float area) {
  const Vec3f to_light = p.point - reference;
  const Float distance2 = dot(to_light, to_light);
  const Float facing = -dot(to_light, p.normal);  // cos at the light, times the distance
  const Float pdf = distance2 * sqrt(distance2) / (facing * area);
  return {origin_at(p), pdf, p.radiance, p.sampled & (facing > 0.0f)};
}

/// Cosine-weighted over directions.
NORRSKEN_INLINE EmittedRay emit_from_surface(const AreaPoint& p, Float area, Vec2f direction) {
  return {origin_at(p), make_frame(p.normal).to_world(warp_to_cosine_hemisphere(direction)), p.radiance * (area * kPi),
          p.sampled};
}

}  // namespace norrsken::NORRSKEN_ISA
