// checkerboard: host side.
//
// Parameters
//   color0, color1  color (defaults 0.4 and 0.2)
//   to_uv           transform (default identity): of texture coordinates, in x and y
// Stored: to_uv (6 floats), color0 (3), color1 (3).
#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "compile/plugins.h"

namespace norrsken {

Texture compile_texture_checkerboard(Parameters& p, Builder& builder) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const glm::dvec3 color0 = p.color("color0", glm::dvec3(0.4), -kAny, kAny);
  const glm::dvec3 color1 = p.color("color1", glm::dvec3(0.2), -kAny, kAny);
  ParameterBlock block;
  add_to_uv(block, p.transform("to_uv"));
  block.add_values(color0).add_values(color1);
  const glm::dvec3 low = glm::min(color0, color1), high = glm::max(color0, color1);
  return {builder.add_texture(TextureKind::checkerboard, block), (color0 + color1) / 2.0,
          std::min({low.x, low.y, low.z}), std::max({high.x, high.y, high.z})};
}

}  // namespace norrsken
