// constant: an environment that shines alike from all directions.
//
// Parameters
//   radiance   color, W / (m^2 sr), at least 0 (default 1)
#include <fmt/format.h>

#include "compile/plugins.h"

namespace norrsken {

void compile_emitter_constant(Parameters& p, Builder& builder, std::uint32_t shape) {
  if (shape != kNone) {
    builder.diagnostics().error(p.node().plugin_location,
                                "emitter 'constant' surrounds the scene and cannot belong to a shape", "area");
  }
  const glm::dvec3 radiance = p.color("radiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  LightRecord light{};
  light.kind = LightKind::constant;
  for (int i = 0; i < 3; ++i) light.emission[i] = static_cast<float>(radiance[i]);
  builder.add_environment(p.node(), light, environment_power(radiance));
  builder.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
}

}  // namespace norrsken
