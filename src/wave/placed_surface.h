// Points of surfaces that stand somewhere by an affine map: analytic shapes in the world or a group, groups in the world.
//
// None of this is inlined: most scenes have none, and every BSDF would repeat it.
#pragma once

#include "accel/hit.h"
#include "shape/models.h"
#include "tables/wave_types.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

struct PlacedSurface {
  Vec3f position;
  Vec3f normal, shading;  ///< unit
  Float scale;            ///< what the rounding of the position along the normal is relative to
  Vec2f uv;
  Vec3f dp_du, dp_dv;
};

/// What rounding is relative to on the way of a point to the local space and back again, along the normal. `local` is
/// what it is relative to within the local space.
/// Source: forward error bounds of sums, as in Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., 6.8.
NORRSKEN_INLINE Float rounding_scale(const Affine& world_from_local, const Affine& local_from_world, const Vec3f& p,
                                     const Vec3f& normal, Float local) {
  const Vec3f there = local_from_world.magnitude(p);
  const Vec3f back = world_from_local.magnitude({max(there.x, local), max(there.y, local), max(there.z, local)});
  return fma(abs(normal.x), back.x, fma(abs(normal.y), back.y, abs(normal.z) * back.z));
}

/// Where the ray met the instance, in the instance's own space.
__attribute__((noinline)) inline Vec3f hit_in_object(const SceneView& scene, Vec3f origin, Vec3f direction, Float t,
                                                     UInt instance, Mask active) {
  const Affine map = object_from_world(scene.instances, instance, active);
  return fma(map.vector(direction), t, map.point(origin));
}

/// From the space of an instance to the world.
__attribute__((noinline)) inline PlacedSurface surface_in_world(const SceneView& scene, UInt instance, PlacedSurface s,
                                                                Mask active) {
  const Affine to = world_from_object(scene.instances, instance, active);
  const Affine from = object_from_world(scene.instances, instance, active);
  PlacedSurface w;
  w.position = to.point(s.position);
  w.normal = normalize(from.transposed(s.normal));
  w.shading = normalize(from.transposed(s.shading));
  w.scale = rounding_scale(to, from, w.position, w.normal, s.scale);
  w.uv = s.uv;
  w.dp_du = to.vector(s.dp_du);
  w.dp_dv = to.vector(s.dp_dv);
  return w;
}

/// The point of the analytic shape `analytic` that is next to `p`; `element` is the one of its elements that was hit.
__attribute__((noinline)) inline PlacedSurface analytic_surface(const SceneView& scene, UInt analytic, UInt element,
                                                                Vec3f p, Mask active) {
  const auto of_shape = [&](auto... members) { return gather(scene.analytics, members..., analytic, active); };
  const Affine to = of_shape(&AnalyticRecord::place, &Placement::world_from_local);
  const Affine from = of_shape(&AnalyticRecord::place, &Placement::local_from_world);
  const UInt kinds = of_shape(&AnalyticRecord::kind);
  const Mask flipped = active & (of_shape(&AnalyticRecord::flip_normals) != 0u);

  const Vec3f local_p = from.point(p);
  const ElementReader table{scene.texels, of_shape(&AnalyticRecord::table), element, active};
  LocalSurface local{};
#define NORRSKEN_ANALYTIC(kind, Model)                                                             \
  if (scene.analytic_kinds & (1u << static_cast<std::uint32_t>(AnalyticKind::kind))) {             \
    const Mask of_kind = active & (kinds == UInt(static_cast<std::uint32_t>(AnalyticKind::kind))); \
    if (any(of_kind)) local = select(of_kind, surface_of<Model>(table, local_p), local);           \
  }
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC

  PlacedSurface s;
  s.position = to.point(local.position);
  const Float sign = select(flipped, Float(-1.0f), Float(1.0f));
  s.normal = normalize(from.transposed(local.normal)) * sign;
  s.shading = normalize(from.transposed(local.shading)) * sign;
  s.scale = rounding_scale(to, from, s.position, s.normal, local.scale);
  s.uv = local.uv;
  s.dp_du = to.vector(local.dp_du);
  s.dp_dv = to.vector(local.dp_dv);
  return s;
}

}  // namespace norrsken::NORRSKEN_ISA
