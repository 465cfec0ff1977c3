// constant: an environment that shines alike from all directions.
//
// Parameters
//   radiance   color, W / (m^2 sr), at least 0 (default 1)
#include <fmt/format.h>

#include "compile/plugins.h"
#include "light/light_host.h"

namespace norrsken {

void compile_emitter_constant(Parameters& p, Builder& builder, std::uint32_t shape) {
  refuse_shape(p, shape, "surrounds the scene");
  const glm::dvec3 radiance = p.color("radiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  LightRecord light{};
  light.kind = LightKind::constant;
  set_values(light.emission, radiance);
  builder.add_environment(p.node(), light, environment_power(radiance));
  builder.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
}

}  // namespace norrsken
