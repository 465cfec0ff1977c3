// Which medium lies on which side of a surface.
#pragma once

#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE Mask is_in_some(UInt medium) { return medium != kNone; }

/// On the side of a primitive's geometric normal that `outside` tells, for rays that are in `medium`. Not inlined: every
/// BSDF would repeat it.
__attribute__((noinline)) inline UInt medium_on_side(const SceneView& scene, UInt primitive, Mask outside, UInt medium,
                                                     Mask active) {
  const UInt shape = shape_of(scene, primitive, active);
  const UInt there = select(outside, gather(scene.shapes, &ShapeRecord::exterior, shape, active),
                            gather(scene.shapes, &ShapeRecord::interior, shape, active));
  return select(there == kSameMedium, medium, there);
}

/// Where a ray goes on that leaves the primitive towards `side` of its geometric normal and came in `medium`.
template <class Scene>
NORRSKEN_INLINE UInt medium_beyond(const Scene& scene, UInt primitive, Float side, UInt medium, Mask active) {
  if (!scene.volumetric) return medium;
  return medium_on_side(scene, primitive, side > 0.0f, medium, active);
}

}  // namespace norrsken::NORRSKEN_ISA
