// Affine maps in lanes, as Placement in src/tables/scene_tables.h stores them.
#pragma once

#include "math/vec3.h"

namespace norrsken::NORRSKEN_ISA {

struct Affine {
  Vec3f row[3];
  Vec3f translation;

  NORRSKEN_INLINE Vec3f vector(const Vec3f& v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  NORRSKEN_INLINE Vec3f point(const Vec3f& p) const { return vector(p) + translation; }
  /// The product with the transposed linear part: what takes normals the other way than this map takes points.
  NORRSKEN_INLINE Vec3f transposed(const Vec3f& n) const { return fma(row[0], n.x, fma(row[1], n.y, row[2] * n.z)); }
  /// Bound of the sum of the absolute terms of `point`, which rounding is relative to.
  NORRSKEN_INLINE Vec3f magnitude(const Vec3f& p) const {
    const auto abs3 = [](const Vec3f& v) { return Vec3f{abs(v.x), abs(v.y), abs(v.z)}; };
    const Vec3f a = abs3(p), t = abs3(translation);
    return {dot(abs3(row[0]), a) + t.x, dot(abs3(row[1]), a) + t.y, dot(abs3(row[2]), a) + t.z};
  }
};

/// 12 floats at base[first], row by row.
NORRSKEN_INLINE Affine gather_affine(const float* base, UInt first, Mask active) {
  Affine a;
  for (int k = 0; k < 3; ++k) a.row[k] = gather3(base + 4 * k, first, active);
  a.translation = {gather(base + 3, first, active), gather(base + 7, first, active), gather(base + 11, first, active)};
  return a;
}

}  // namespace norrsken::NORRSKEN_ISA
