// checkerboard: host side.
//
// Parameters
//   color0, color1  color (defaults 0.4 and 0.2)
//   to_uv           transform (default identity): of texture coordinates, in x and y
// Where it stands for a number, such as a roughness, that is the mean of a colour, and the two change places: so do
// Mitsuba's images show it.
// Stored: to_uv (6 floats), color0 (3), color1 (3); and again for numbers.
#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "compile/plugins.h"

namespace norrsken {

Texture compile_texture_checkerboard(Parameters& p, Builder& builder) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const glm::dvec3 color0 = p.color("color0", glm::dvec3(0.4), -kAny, kAny);
  const glm::dvec3 color1 = p.color("color1", glm::dvec3(0.2), -kAny, kAny);
  const glm::dmat4 transform = p.transform("to_uv");
  const auto add = [&](const glm::dvec3& first, const glm::dvec3& second) {
    ParameterBlock block;
    add_to_uv(block, transform);
    return builder.add_texture(TextureKind::checkerboard, block.add_values(first).add_values(second));
  };
  const glm::dvec3 low = glm::min(color0, color1), high = glm::max(color0, color1);
  Texture texture;
  texture.word = add(color0, color1);
  const auto mean = [](const glm::dvec3& c) { return glm::dvec3((c.x + c.y + c.z) / 3); };
  texture.number = add(mean(color1), mean(color0));
  texture.mean = (color0 + color1) / 2.0;
  texture.min = std::min({low.x, low.y, low.z});
  texture.max = std::max({high.x, high.y, high.z});
  return texture;
}

}  // namespace norrsken
