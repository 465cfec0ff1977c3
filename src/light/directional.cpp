// directional: parallel light from infinitely far away, from one direction.
#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "light/light_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kIrradiance{.name = "irradiance",
                                     .fallback = 1,
                                     .range = {0, kMaxEmission},
                                     .text = "of a surface at right angles to the light",
                                     .unit = "W / m^2",
                                     .of = ColorOf::light};
constexpr PointParameter kDirection{.name = "direction", .fallback = {0, 0, 1}, .text = "where the light goes; not 0"};
constexpr TransformParameter kToWorld{.name = "to_world",
                                      .text = "the light goes where it takes +z; its scale does not matter",
                                      .in_place_of = "direction"};

}  // namespace

void compile_emitter_directional(Parameters& p, Lights& lights, std::uint32_t /*shape*/) {
  if (p.has(kDirection.name) && p.has(kToWorld.name)) {
    p.error(kToWorld.name, "emitter 'directional' has both 'direction' and 'to_world'", "one of them");
  }
  glm::dvec3 direction = p.read(kDirection);
  const glm::dmat4 to_world = p.read(kToWorld);
  if (p.has(kToWorld.name)) direction = to_world[2];
  if (direction == glm::dvec3(0)) {
    p.error(kDirection.name, "'direction' is (0, 0, 0)", "a vector with a length");
    direction = kDirection.fallback;
  }
  const glm::dvec3 irradiance = p.read(kIrradiance).rgb();
  LightRecord light{};
  light.kind = LightKind::directional;
  // Scaled first, so that squares of tiny and of huge components stay numbers.
  const glm::dvec3 size = glm::abs(direction);
  set_values(light.normal, glm::normalize(direction / std::max({size.x, size.y, size.z})));
  set_values(light.emission, irradiance);
  lights.add(light, directional_power(irradiance));
  lights.describe(p.node(), fmt::format("irradiance {:.6g} {:.6g} {:.6g}", irradiance.r, irradiance.g, irradiance.b));
}

}  // namespace norrsken
