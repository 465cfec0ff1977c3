// The family of piecewise cubic filters with radius 2.
#pragma once

#include <cmath>

#include "rfilter/filter_host.h"

namespace norrsken {

/// Source: Mitchell and Netravali, "Reconstruction Filters in Computer Graphics", 1988, equation 8.
inline FilterFunction cubic_filter(double b, double c) {
  const auto value = [b, c](double x) {
    if (x < 1) return (((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b)) / 6;
    return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
  };
  return {value, 2, 1.0 / 128};
}

}  // namespace norrsken
