// What stages that intersect share: from an intersector's answer to hits, and on from there.
#pragma once

#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE void set_end(Hit& hit, const ClosestHit& closest) {
  hit.t = closest.t;
  hit.primitive = closest.primitive_side & kPrimitiveMask;
  hit.instance = closest.instance;
}

/// The ray of a hit goes on behind what it hit.
NORRSKEN_INLINE void step_behind(const SceneView& scene, Hit& hit, Mask active) {
  const SurfacePoint surface = make_surface_point(scene, hit, active);
  const Float side = dot(hit.ray.direction, surface.normal);
  const Vec3f behind = spawn_origin(surface.position, surface.normal, surface.offset, side);
  hit.ray.origin = select(active, behind, hit.ray.origin);
}

inline constexpr std::uint32_t kModelKinds = (1u << kModelCount) - 1u;

/// The lanes whose material is looked through before shading: it stands before others.
NORRSKEN_INLINE Mask is_unresolved(UInt material) {
  return !(to_float(material & kMaterialKindMask) < static_cast<float>(kModelCount << 24));
}

/// To the queue of the model that the hit's material names, if it is in the bit set `wanted_kinds`.
NORRSKEN_INLINE void push_by_kind(const SceneView& scene, const Hit& hit, std::uint32_t wanted_kinds,
                                  Hits (&hits)[kModelCount], Mask active) {
  const UInt kind_bits = hit.material & kMaterialKindMask;
  for (std::uint32_t kinds = scene.bsdf_kinds & wanted_kinds & kModelKinds; kinds != 0; kinds &= kinds - 1) {
    const auto kind = static_cast<std::uint32_t>(__builtin_ctz(kinds));
    const Mask of_kind = active & (kind_bits == kind << 24);
    if (any(of_kind)) push(scene, hits[kind], hit, of_kind);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
