// Shapes made of elements as Embree sees them: curves are Embree's own, the voxels of a grid are asked of us.
#pragma once

#include <embree3/rtcore.h>

#include "accel/build.h"

namespace norrsken {

/// Whether shapes of the kind are made of elements, see src/shape/shape.h.
bool has_elements(AnalyticKind kind);

/// The geometry of one such shape, to commit and attach; borrows the shape.
RTCGeometry make_embree_elements(RTCDevice device, const ElementShape& shape);

}  // namespace norrsken
