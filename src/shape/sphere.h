// How spheres are rotated, and their texture coordinates.
#pragma once

#include "math/gather.h"
#include "math/special.h"
#include "math/warp.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// The local axes, as rows.
struct SphereRotation {
  Vec3f row[3];

  NORRSKEN_INLINE Vec3f local(const Vec3f& v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  NORRSKEN_INLINE Vec3f world(const Vec3f& v) const { return fma(row[0], v.x, fma(row[1], v.y, row[2] * v.z)); }
};

NORRSKEN_INLINE SphereRotation gather_sphere_rotation(const SceneView& scene, UInt shape, Mask active) {
  const UInt offset = gather(scene.shapes, &ShapeRecord::object_from_world, shape, active);
  const Mask rotated = active & (offset != kNone);
  SphereRotation r;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3f unit{Float(k == 0 ? 1.0f : 0.0f), Float(k == 1 ? 1.0f : 0.0f), Float(k == 2 ? 1.0f : 0.0f)};
    r.row[k] = any(rotated) ? select(rotated, gather3(scene.parameters + 3 * k, offset, rotated), unit) : unit;
  }
  return r;
}

/// u turns around the local z axis, v goes from the pole at +z to that at -z, as in Mitsuba; of a unit vector.
NORRSKEN_INLINE Vec2f sphere_uv(const Vec3f& local) {
  const Float turn = atan2(local.y, local.x) * Float(0.5f * kInvPi);
  return {select(turn < 0.0f, turn + 1.0f, turn), acos(local.z) * kInvPi};
}

}  // namespace norrsken::NORRSKEN_ISA
