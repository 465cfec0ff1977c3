// What an analytic shape gives to intersection, shading and light sampling: all in its local space, where it has its
// simplest form. Its place in the world is an affine map: directions and tangents go through the linear part, normals
// through the inverse transpose; distances along a ray whose direction is not normalised again are the same in both.
//
// A shape is a struct with
//   static LocalHit intersect(const Vec3f& o, const Vec3f& d, Float t_max);   nearest within (0, t_max)
//   static LocalSurface surface_at(const Vec3f& p);                           p on the surface but for rounding
// or, if it is made of elements (segments, voxels) that a table tells, found by src/accel/embree_elements.cpp,
//   static LocalSurface surface_at(const ElementReader& table, const Vec3f& p);
// and, unless only rays find it as a light,
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
  Vec3f shading = normal;  ///< unit
  Float scale = 1.0f;      ///< bound of what rounding in the local space is relative to
};

/// The numbers that a shape's host file left in its table, and which of its elements was hit.
struct ElementReader {
  const float* table;  ///< SceneTables::texels
  UInt offset;         ///< of the shape's first number
  UInt element;
  Mask active;

  NORRSKEN_INLINE Float number(UInt k) const { return gather(table, offset + k, active); }
  NORRSKEN_INLINE UInt word(UInt k) const { return gather_uint(table, offset + k, active); }
};

/// True for shapes that are made of elements.
template <class Model>
inline constexpr bool kHasElements = requires(const ElementReader& table, const Vec3f& p) {
  Model::surface_at(table, p);
};

template <class Model>
NORRSKEN_INLINE LocalSurface surface_of(const ElementReader& table, const Vec3f& p) {
  if constexpr (kHasElements<Model>) {
    return Model::surface_at(table, p);
  } else {
    return Model::surface_at(p);
  }
}

/// False for shapes whose area nothing samples: as lights, only rays find them.
template <class Model>
inline constexpr bool kCanBeSampled = requires(Vec2f u) {
  Model::sample(u);
};

NORRSKEN_INLINE LocalSurface select(Mask m, const LocalSurface& a, const LocalSurface& b) {
  return {select(m, a.position, b.position), select(m, a.normal, b.normal), select(m, a.uv, b.uv),
          select(m, a.dp_du, b.dp_du),       select(m, a.dp_dv, b.dp_dv),   select(m, a.shading, b.shading),
          select(m, a.scale, b.scale)};
}

}  // namespace norrsken::NORRSKEN_ISA
