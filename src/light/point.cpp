// point: an emitter that shines alike in all directions from one point.
//
// Parameters
//   position   point, scene units (default 0 0 0)
//   to_world   transform, in place of `position`: the light is where it takes the origin
//   intensity  color, radiant intensity in W / sr, at least 0 (default 1)
#include <fmt/format.h>

#include "compile/plugins.h"

namespace norrsken {

void compile_emitter_point(Parameters& p, Builder& builder, std::uint32_t shape) {
  if (shape != kNone) {
    builder.diagnostics().error(p.node().plugin_location, "emitter 'point' has no surface and cannot belong to a shape",
                                "area");
  }
  if (p.has("position") && p.has("to_world")) {
    p.error("to_world", "emitter 'point' has both 'position' and 'to_world'", "one of them");
  }
  glm::dvec3 position = p.point("position", glm::dvec3(0));
  const glm::dmat4 to_world = p.transform("to_world");
  if (p.has("to_world")) position = to_world[3];
  const glm::dvec3 intensity = p.color("intensity", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  LightRecord light{};
  light.kind = LightKind::point;
  for (int i = 0; i < 3; ++i) {
    light.origin[i] = static_cast<float>(position[i]);
    light.emission[i] = static_cast<float>(intensity[i]);
  }
  builder.add_light(light, point_power(intensity));
  builder.describe(p.node(), fmt::format("intensity {:.6g} {:.6g} {:.6g}", intensity.r, intensity.g, intensity.b));
}

}  // namespace norrsken
