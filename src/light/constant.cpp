// constant: an environment that shines alike from all directions.
#include <fmt/core.h>

#include "light/light_host.h"

namespace norrsken {

void compile_emitter_constant(Parameters& p, Lights& lights, std::uint32_t shape) {
  refuse_shape(p, shape, "surrounds the scene");
  const glm::dvec3 radiance = p.read(kUniformRadiance).rgb();
  LightRecord light{};
  light.kind = LightKind::constant;
  set_values(light.emission, radiance);
  lights.add_environment(p.node(), light, environment_power(radiance));
  lights.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
}

}  // namespace norrsken
