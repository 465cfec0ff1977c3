// point: an emitter that shines alike in all directions from one point.
//
// Parameters
//   position   point, scene units (default 0 0 0)
//   to_world   transform, in place of `position`: the light is where it takes the origin
//   intensity  color, radiant intensity in W / sr, at least 0 (default 1)
#include <fmt/format.h>

#include "compile/plugins.h"
#include "light/light_host.h"

namespace norrsken {

void compile_emitter_point(Parameters& p, Builder& builder, std::uint32_t /*shape*/) {
  if (p.has("position") && p.has("to_world")) {
    p.error("to_world", "emitter 'point' has both 'position' and 'to_world'", "one of them");
  }
  glm::dvec3 position = p.point("position", glm::dvec3(0));
  const glm::dmat4 to_world = p.transform("to_world");
  if (p.has("to_world")) position = to_world[3];
  const glm::dvec3 intensity = p.color("intensity", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  LightRecord light{};
  light.kind = LightKind::point;
  set_values(light.origin, position);
  set_values(light.emission, intensity);
  builder.add_light(light, point_power(intensity, {.lower = position, .upper = position}));
  builder.describe(p.node(), fmt::format("intensity {:.6g} {:.6g} {:.6g}", intensity.r, intensity.g, intensity.b));
}

}  // namespace norrsken
