// Flakes that lie in all directions, some more than others: the squared radii of an ellipsoid whose projected areas are
// theirs. Source: Heitz, Dupuy, Crassin, Dachsbacher, "The SGGX Microflake Distribution", 2015.
#pragma once

#include "math/vec3.h"
#include "medium/volume.h"

namespace norrsken::NORRSKEN_ISA {

/// A symmetric matrix.
struct Flakes {
  Float xx, yy, zz, xy, xz, yz;

  NORRSKEN_INLINE Vec3f times(const Vec3f& v) const {
    return {fma(xx, v.x, fma(xy, v.y, xz * v.z)), fma(xy, v.x, fma(yy, v.y, yz * v.z)),
            fma(xz, v.x, fma(yz, v.y, zz * v.z))};
  }
  /// u^T S v
  NORRSKEN_INLINE Float form(const Vec3f& u, const Vec3f& v) const { return dot(u, times(v)); }
  NORRSKEN_INLINE Float determinant() const {
    const Float a = yy * zz - yz * yz, b = xy * zz - yz * xz, c = xy * yz - yy * xz;
    return max(fma(xx, a, fnma(xy, b, xz * c)), 1e-30f);
  }
  /// v^T S^-1 v times the determinant.
  NORRSKEN_INLINE Float adjugate_form(const Vec3f& v) const {
    const Flakes adjugate{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                          xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - yz * xx};
    return adjugate.form(v, v);
  }
};

__attribute__((noinline)) inline Flakes flakes_at(const SceneView& scene, UInt volume, Vec3f position, Mask active) {
  const auto v = evaluate_channels<6>(scene, volume, position, active);
  return {v.channel[0], v.channel[1], v.channel[2], v.channel[3], v.channel[4], v.channel[5]};
}

/// Of the flakes in a unit of volume, as seen along the direction.
NORRSKEN_INLINE Float projected_area(const Flakes& s, const Vec3f& direction) {
  return sqrt(max(s.form(direction, direction), 1e-20f));
}

}  // namespace norrsken::NORRSKEN_ISA
