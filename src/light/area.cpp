// area: makes the shape that it stands in shine from its front, alike in all directions.
//
// Parameters
//   radiance   color, W / (m^2 sr), at least 0 (default 1)
// One light per sphere and per triangle; two triangles of a shape that make a parallelogram are one light, so that it
// is chosen and sampled as a whole.
#include <fmt/format.h>

#include "compile/plugins.h"
#include "light/area_host.h"

namespace norrsken {

void compile_emitter_area(Parameters& p, Builder& builder, std::uint32_t shape) {
  const glm::dvec3 radiance = p.color("radiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  builder.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
  if (shape == kNone) {
    builder.diagnostics().error(p.node().plugin_location, "emitter 'area' stands outside of a shape",
                                "an area emitter inside of the shape that shines");
    return;
  }
  for (AreaLight& light : area_lights(builder, shape)) {
    for (int i = 0; i < 3; ++i) light.record.emission[i] = static_cast<float>(radiance[i]);
    const std::uint32_t index = builder.add_light(light.record, surface_power(double{light.record.area}, radiance));
    for (const std::uint32_t primitive : light.primitives) {
      if (primitive == kNone) continue;
      SurfaceRecord& surface = builder.surfaces_of(shape)[primitive];
      surface.light = index;
      surface.material_front |= kEmitsBit;
    }
  }
}

}  // namespace norrsken
