// directional: parallel light from infinitely far away, from one direction.
//
// Parameters
//   irradiance  color, of a surface at right angles to the light in W / m^2, at least 0 (default 1)
//   direction   vector (default 0 0 1), not 0: where the light goes
//   to_world    transform, in place of `direction`: the light goes where it takes +z; its scale does not matter
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "compile/plugins.h"
#include "light/light_host.h"

namespace norrsken {

void compile_emitter_directional(Parameters& p, Builder& builder, std::uint32_t /*shape*/) {
  if (p.has("direction") && p.has("to_world")) {
    p.error("to_world", "emitter 'directional' has both 'direction' and 'to_world'", "one of them");
  }
  glm::dvec3 direction = p.point("direction", glm::dvec3(0, 0, 1));
  const glm::dmat4 to_world = p.transform("to_world");
  if (p.has("to_world")) direction = to_world[2];
  if (direction == glm::dvec3(0)) {
    p.error("direction", "'direction' is (0, 0, 0)", "a vector with a length");
    direction = {0, 0, 1};
  }
  const glm::dvec3 irradiance = p.color("irradiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  LightRecord light{};
  light.kind = LightKind::directional;
  // Scaled first, so that squares of tiny and of huge components stay numbers.
  const glm::dvec3 size = glm::abs(direction);
  set_values(light.normal, glm::normalize(direction / std::max({size.x, size.y, size.z})));
  set_values(light.emission, irradiance);
  builder.add_light(light, directional_power(irradiance));
  builder.describe(p.node(), fmt::format("irradiance {:.6g} {:.6g} {:.6g}", irradiance.r, irradiance.g, irradiance.b));
}

}  // namespace norrsken
