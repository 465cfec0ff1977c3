// What stands beside a hierarchy of triangles: a few spheres, disks and cylinders, tried one by one.
#pragma once

#include "accel/sphere.h"
#include "math/affine.h"
#include "shape/models.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// Calls `function` with the shape's class; shapes with elements are Embree's.
template <class Function>
NORRSKEN_INLINE void with_model(AnalyticKind kind, const Function& function) {
  switch (kind) {
#define NORRSKEN_ANALYTIC(kind, Model)                     \
  case AnalyticKind::kind:                                 \
    if constexpr (!kHasElements<Model>) function(Model()); \
    break;
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC
    case AnalyticKind::count:
      break;
  }
}

NORRSKEN_INLINE void closest_analytic(const AnalyticRecord& a, std::uint32_t primitive, const Vec3f& o, const Vec3f& d,
                                      ClosestHit& hit) {
  const Affine local_from_world = gather_affine(a.place.local_from_world, UInt(0u), first_lanes(kLanes));
  const Vec3f local_o = local_from_world.point(o), local_d = local_from_world.vector(d);
  with_model(a.kind, [&](auto model) {
    const LocalHit met = model.intersect(local_o, local_d, hit.t);
    const Vec3f n = model.surface_at(fma(local_d, met.t, local_o)).normal;
    const Mask along = (dot(n, local_d) > Float(0.0f)) ^ (Float(static_cast<float>(a.flip_normals)) > Float(0.0f));
    const UInt side = select(along, UInt(kBackSide), UInt(0u));
    hit.t = select(met.hit, met.t, hit.t);
    hit.primitive_side = select(met.hit, side | UInt(primitive), hit.primitive_side);
  });
}

NORRSKEN_INLINE void closest_beside(const AccelView& accel, const Vec3f& o, const Vec3f& d, ClosestHit& hit) {
  for (std::uint32_t k = 0; k < accel.sphere_count; ++k) closest_sphere(accel.spheres[k], o, d, hit);
  for (std::uint32_t k = 0; k < accel.analytic_count; ++k) {
    closest_analytic(accel.analytics[k], accel.first_analytic + k, o, d, hit);
  }
}

/// Whether any of them is nearer than `t_max`.
NORRSKEN_INLINE Mask occluded_beside(const AccelView& accel, const Vec3f& o, const Vec3f& d, Float t_max) {
  Mask occluded = Mask::none();
  for (std::uint32_t k = 0; k < accel.sphere_count; ++k) {
    occluded |= occluded_by_sphere(accel.spheres[k], o, d, t_max);
  }
  for (std::uint32_t k = 0; k < accel.analytic_count; ++k) {
    const AnalyticRecord& a = accel.analytics[k];
    const Affine local_from_world = gather_affine(a.place.local_from_world, UInt(0u), first_lanes(kLanes));
    with_model(a.kind, [&](auto model) {
      occluded |= model.intersect(local_from_world.point(o), local_from_world.vector(d), t_max).hit;
    });
  }
  return occluded;
}

}  // namespace norrsken::NORRSKEN_ISA
