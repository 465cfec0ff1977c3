// Multiple importance sampling of one estimator with n samples against one with a single sample.
// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, eq. 9.13 (power heuristic, beta 2).
#pragma once

#include "simd/lanes.h"

namespace norrsken::NORRSKEN_ISA {

/// Weight of a sample drawn from `count` samples of density `pdf` where `other_count` samples of `other` compete.
NORRSKEN_INLINE Float power_heuristic(Float count, Float pdf, Float other_count, Float other) {
  // As a ratio, so that squares of large densities do not overflow.
  const Float ratio = (other_count * other) / (count * pdf);
  return Float(1.0f) / fma(ratio, ratio, Float(1.0f));
}

}  // namespace norrsken::NORRSKEN_ISA
