// Curves for Embree. Neither kind is hit from inside.
#pragma once

#include <embree3/rtcore.h>

#include "accel/build.h"

namespace norrsken {

/// To commit and attach; both borrow the shape, whose table src/shape/curve.h describes.
RTCGeometry make_embree_linear_curves(RTCDevice device, const ElementShape& shape);
RTCGeometry make_embree_bspline_curves(RTCDevice device, const ElementShape& shape);

}  // namespace norrsken
