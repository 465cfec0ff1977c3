// Rays in arrays, as they go in and out of kernels that only intersect.
#pragma once

#include "accel/intersect.h"
#include "isa/entry.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE RayFields fields_of(const RayArrays& rays) {
  const float* const o[3] = {rays.ox, rays.oy, rays.oz};
  const float* const d[3] = {rays.dx, rays.dy, rays.dz};
  return {o, d};
}

}  // namespace norrsken::NORRSKEN_ISA
