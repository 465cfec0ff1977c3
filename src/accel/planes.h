// The intersector for small scenes: every plane of the scene once per ray, then the polygons in it.
//
// Model       Coplanar triangles of one surface are merged into convex polygons (src/accel/planes_build.cpp), so that a
//             wall of two triangles or a floor of six costs one division and a few edge tests.
// Source      projection to the dominant axis: Wald 2004, section 7.1.1; see src/tables/accel_tables.h for the records.
// Departures  polygons instead of triangles, edge functions instead of barycentric coordinates.
#pragma once

#include "accel/hit.h"
#include "accel/sphere.h"
#include "tables/accel_tables.h"

namespace norrsken::NORRSKEN_ISA {

/// A ray with its components in the order that planes of axis `axis` want: k, then u, then v.
template <int axis>
struct PermutedRay {
  Float ok, ou, ov, dk, du, dv;
  NORRSKEN_INLINE PermutedRay(const Vec3f& o, const Vec3f& d) {
    if constexpr (axis == 0) {
      ok = o.x, ou = o.y, ov = o.z, dk = d.x, du = d.y, dv = d.z;
    } else if constexpr (axis == 1) {
      ok = o.y, ou = o.z, ov = o.x, dk = d.y, du = d.z, dv = d.x;
    } else {
      ok = o.z, ou = o.x, ov = o.y, dk = d.z, du = d.x, dv = d.y;
    }
  }
};

struct PlaneCrossing {
  Float t, n_dot_d;
};

template <int axis>
NORRSKEN_INLINE PlaneCrossing cross_plane(const PlaneRecord& plane, const PermutedRay<axis>& r) {
  const Float n_dot_d = fma(Float(plane.nu), r.du, fma(Float(plane.nv), r.dv, r.dk));
  const Float distance = fnma(Float(plane.nu), r.ou, fnma(Float(plane.nv), r.ov, Float(plane.c) - r.ok));
  return {distance / n_dot_d, n_dot_d};
}

NORRSKEN_INLINE Mask inside_polygon(const PolygonRecord& polygon, const PolygonRow* rows, Float u, Float v) {
  const PolygonRow* row = rows + polygon.first_row;
  if (polygon.kind == PolygonKind::parallelogram) {
    const Float a = fma(Float(row[0].u), u, fma(Float(row[0].v), v, Float(row[0].w)));
    const Float b = fma(Float(row[1].u), u, fma(Float(row[1].v), v, Float(row[1].w)));
    return max(abs(a), abs(b)) <= 1.0f;
  }
  Float smallest = fma(Float(row[0].u), u, fma(Float(row[0].v), v, Float(row[0].w)));
  for (std::uint32_t i = 1; i < polygon.row_count; ++i) {
    smallest = min(smallest, fma(Float(row[i].u), u, fma(Float(row[i].v), v, Float(row[i].w))));
  }
  return smallest >= 0.0f;
}

template <int axis>
NORRSKEN_INLINE void closest_in_planes_of_axis(const AccelView& accel, const PlaneSet& set, const Vec3f& o,
                                               const Vec3f& d, ClosestHit& hit) {
  const PermutedRay<axis> r(o, d);
  for (std::uint32_t i = set.axis_begin[axis]; i < set.axis_begin[axis + 1]; ++i) {
    const PlaneRecord& plane = accel.planes[i];
    const PlaneCrossing c = cross_plane(plane, r);
    const Mask closer = (c.t > 0.0f) & (c.t < hit.t);
    if (none(closer)) continue;
    const Float u = fma(c.t, r.du, r.ou), v = fma(c.t, r.dv, r.ov);
    const UInt side = (bits(c.n_dot_d) ^ UInt(plane.back_flip)) & kBackSide;
    for (std::uint32_t j = 0; j < plane.polygon_count; ++j) {
      const PolygonRecord& polygon = accel.polygons[plane.first_polygon + j];
      const Mask found = closer & inside_polygon(polygon, accel.rows, u, v);
      hit.t = select(found, c.t, hit.t);
      hit.primitive_side = select(found, side | UInt(polygon.primitive), hit.primitive_side);
    }
  }
}

template <int axis>
NORRSKEN_INLINE Mask occluded_in_planes_of_axis(const AccelView& accel, const PlaneSet& set, const Vec3f& o,
                                                const Vec3f& d, Float t_max) {
  const PermutedRay<axis> r(o, d);
  Mask occluded = Mask::none();
  for (std::uint32_t i = set.axis_begin[axis]; i < set.axis_begin[axis + 1]; ++i) {
    const PlaneRecord& plane = accel.planes[i];
    const PlaneCrossing c = cross_plane(plane, r);
    const Mask between = (c.t > 0.0f) & (c.t < t_max);
    const Float u = fma(c.t, r.du, r.ou), v = fma(c.t, r.dv, r.ov);
    for (std::uint32_t j = 0; j < plane.polygon_count; ++j) {
      occluded |= between & inside_polygon(accel.polygons[plane.first_polygon + j], accel.rows, u, v);
    }
  }
  return occluded;
}

/// The closest hit nearer than `hit.t` among the planes of `set` and the first `sphere_count` spheres.
NORRSKEN_INLINE void closest_in_planes(const AccelView& accel, const PlaneSet& set, std::uint32_t sphere_count,
                                       const Vec3f& o, const Vec3f& d, ClosestHit& hit) {
  closest_in_planes_of_axis<0>(accel, set, o, d, hit);
  closest_in_planes_of_axis<1>(accel, set, o, d, hit);
  closest_in_planes_of_axis<2>(accel, set, o, d, hit);
  for (std::uint32_t i = 0; i < sphere_count; ++i) closest_sphere(accel.spheres[i], o, d, hit);
}

/// Whether any occluder lies strictly between the origin and `t_max`.
NORRSKEN_INLINE Mask occluded_in_planes(const AccelView& accel, const Vec3f& o, const Vec3f& d, Float t_max) {
  Mask occluded = occluded_in_planes_of_axis<0>(accel, accel.occluders, o, d, t_max) |
                  occluded_in_planes_of_axis<1>(accel, accel.occluders, o, d, t_max) |
                  occluded_in_planes_of_axis<2>(accel, accel.occluders, o, d, t_max);
  for (std::uint32_t i = 0; i < accel.sphere_count; ++i) {
    occluded |= occluded_by_sphere(accel.spheres[i], o, d, t_max);
  }
  return occluded;
}

}  // namespace norrsken::NORRSKEN_ISA
