// Grids of signed distances as Embree sees them: a user primitive for each voxel that the surface crosses.
#pragma once

#include <embree3/rtcore.h>

#include "accel/build.h"

namespace norrsken {

/// To commit and attach; borrows the shape.
RTCGeometry make_embree_grid(RTCDevice device, const ElementShape& shape);

}  // namespace norrsken
