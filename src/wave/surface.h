// From a hit to the surface there: position, normals, and the offset that keeps spawned rays off it.
#pragma once

#include "accel/intersect.h"
#include "math/frame.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

/// A surface point as shading sees it. Normals point to the side that the ray came from.
struct SurfacePoint {
  Vec3f position;
  Vec3f normal;  ///< geometric
  Frame frame;   ///< around the shading normal
  Float offset;  ///< bound of how far rounding may have moved the position off the surface, with reserve
  UInt shape;
};

NORRSKEN_INLINE UInt record_index(UInt primitive) { return primitive * UInt(sizeof(SurfaceRecord) / sizeof(float)); }

NORRSKEN_INLINE const float* surface_floats(const SceneView& scene) {
  return reinterpret_cast<const float*>(scene.surfaces);
}

/// Interpolated shading normal of smooth triangles, barycentric coordinates recomputed from the position.
inline Vec3f smooth_normal(const SceneView& scene, UInt primitive, const Vec3f& p, Mask active) {
  const auto* vertices = reinterpret_cast<const float*>(scene.triangle_vertices);
  const UInt first = primitive * UInt(3u);
  Vec3f corner_position[3], corner_normal[3];
  for (int k = 0; k < 3; ++k) {
    const UInt vertex = gather_uint(vertices + k, first, active) * UInt(3u);
    corner_position[k] = gather3(scene.positions, vertex, active);
    corner_normal[k] = gather3(scene.normals, vertex, active);
  }
  const Vec3f e1 = corner_position[1] - corner_position[0], e2 = corner_position[2] - corner_position[0];
  const Vec3f q = p - corner_position[0];
  const Float a11 = dot(e1, e1), a12 = dot(e1, e2), a22 = dot(e2, e2), b1 = dot(q, e1), b2 = dot(q, e2);
  const Float inv = Float(1.0f) / fms(a11, a22, a12 * a12);
  const Float u = fms(a22, b1, a12 * b2) * inv, v = fms(a11, b2, a12 * b1) * inv;
  return normalize(fma(corner_normal[1], u, fma(corner_normal[2], v, corner_normal[0] * (Float(1.0f) - u - v))));
}

NORRSKEN_INLINE SurfacePoint make_surface_point(const SceneView& scene, const Hit& hit, Mask active) {
  const float* records = surface_floats(scene);
  const UInt index = record_index(hit.primitive);
  const Vec3f geometry = gather3(records, index, active);
  const Float fourth = gather(records + 3, index, active);
  const Vec3f along = fma(hit.ray.direction, hit.t, hit.ray.origin);

  // A triangle's record is its plane: move the point onto it.
  SurfacePoint s;
  s.normal = geometry;
  s.position = fma(geometry, fourth - dot(geometry, along), along);
  Float scale = largest(s.position);
  const Mask sphere = active & !(to_float(hit.primitive) < Float(static_cast<float>(scene.triangle_count)));
  if (scene.accel.triangle_extent != nullptr) {
    const Mask triangle = active & !sphere;
    scale = max(scale, zero_unless(triangle, gather(scene.accel.triangle_extent, hit.primitive, triangle)));
  }
  if (scene.sphere_count > 0) {
    if (any(sphere)) {
      const Vec3f n = normalize(along - geometry);
      s.normal = select(sphere, n, s.normal);
      s.position = select(sphere, fma(n, fourth, geometry), s.position);
      scale = select(sphere, largest(s.position) + fourth, scale);
    }
  }
  s.offset = scale * Float(kOffsetUlps);

  Vec3f shading = s.normal;
  if (scene.any_smooth) {
    s.shape = gather_uint(records + 7, index, active);
    const auto* shapes = reinterpret_cast<const float*>(scene.shapes);
    const UInt smooth = gather_uint(shapes + 2, s.shape * UInt(sizeof(ShapeRecord) / sizeof(float)), active);
    const Mask interpolate = active & (smooth != UInt(0u));
    if (any(interpolate)) {
      shading = select(interpolate, smooth_normal(scene, hit.primitive, s.position, interpolate), shading);
    }
  }
  const Mask back = dot(s.normal, hit.ray.direction) > Float(0.0f);
  const Float sign = select(back, Float(-1.0f), Float(1.0f));
  s.normal = s.normal * sign;
  s.frame = make_frame(shading * sign);
  return s;
}

/// Where a ray that leaves towards `side` of the surface begins.
NORRSKEN_INLINE Vec3f spawn_origin(const Vec3f& position, const Vec3f& normal, Float offset, Float side) {
  return fma(normal, copysign(offset, side), position);
}

}  // namespace norrsken::NORRSKEN_ISA
