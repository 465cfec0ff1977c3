// A shape's surface cut into the pieces that next-event estimation samples.
#pragma once

#include <array>
#include <vector>

#include "compile/builder.h"

namespace norrsken {

/// A light without its emission, and the shape's primitives (counted from its first) that it covers; kNone for none.
struct AreaLight {
  LightRecord record{};
  std::array<std::uint32_t, 2> primitives{kNone, kNone};
};

/// In order of the first primitive of each. Two triangles become one parallelogram if they share an edge, face the same
/// way, and the corners across that edge mirror each other in its middle, to within the rounding of their coordinates.
std::vector<AreaLight> area_lights(Builder& builder, std::uint32_t shape);

}  // namespace norrsken
