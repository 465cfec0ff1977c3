// Whether two images can be estimates of the same picture.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "norrsken/compare.h"

namespace norrsken {

/// R, G, B of an image, or three of another kind.
using Planes = std::array<const std::vector<float>*, 3>;

/// Equal values are no distance apart, infinities too.
inline double difference_of(float a, float b) { return a == b ? 0.0 : static_cast<double>(a) - static_cast<double>(b); }

/// Of images whose rows have `width` pixels. Variances are null where an image has none; nothing if neither has.
std::optional<Comparison::ZTest> z_test(int width, const Planes& a, const Planes& b, const Planes& variance_a,
                                        const Planes& variance_b);

}  // namespace norrsken
