// What an analytic shape gives to intersection, shading and light sampling: all in its local space, where it has its
// simplest form. Its place in the world is an affine map: directions and tangents go through the linear part, normals
// through the inverse transpose; distances along a ray whose direction is not normalised again are the same in both.
//
// A shape is a struct with
//   static LocalHit intersect(const Vec3f& o, const Vec3f& d, Float t_max);   nearest within (0, t_max)
//   static LocalSurface surface_at(const Vec3f& p);                           p on the surface but for rounding
//   static LocalPoint sample(Vec2f u);                                        uniform over the local area
// A sampled point's density is one over the area: the placed one, because the maps that the host admits keep uniform
// points uniform.
#pragma once

#include "math/vec3.h"
#include "math/warp.h"

namespace norrsken::NORRSKEN_ISA {

struct LocalHit {
  Float t;  ///< anything where nothing is hit
  Mask hit;
};

struct LocalPoint {
  Vec3f position;
  Vec3f normal;  ///< unit
};

struct LocalSurface {
  Vec3f position;  ///< `p`, moved onto the surface
  Vec3f normal;    ///< unit
  Vec2f uv;
  Vec3f dp_du, dp_dv;
};

/// False for shapes whose area nothing samples: as lights, only rays find them.
template <class Model>
inline constexpr bool kCanBeSampled = requires(Vec2f u) {
  Model::sample(u);
};

NORRSKEN_INLINE LocalSurface select(Mask m, const LocalSurface& a, const LocalSurface& b) {
  return {select(m, a.position, b.position), select(m, a.normal, b.normal), select(m, a.uv, b.uv),
          select(m, a.dp_du, b.dp_du), select(m, a.dp_dv, b.dp_dv)};
}

}  // namespace norrsken::NORRSKEN_ISA
