// area: makes the shape that it stands in shine from its front, alike in all directions.
//
// Parameters
//   radiance   color or texture, W / (m^2 sr), at least 0 (default 1)
// One light per triangle, sphere, disk and cylinder; two triangles of a shape that make a parallelogram are one light, so
// that it is chosen and sampled as a whole. The front is that of the geometric normal, as in Mitsuba: normals that a coarse
// mesh is smoothed by change nothing about where it shines to, and its facets are seen.
#include <fmt/format.h>

#include "compile/plugins.h"
#include "light/area_host.h"
#include "light/light_host.h"

namespace norrsken {

void compile_emitter_area(Parameters& p, Builder& builder, std::uint32_t shape) {
  const auto [radiance, texture] = builder.color(p, "radiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  builder.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
  if (shape == kNone) {
    builder.diagnostics().error(p.node().plugin_location, "emitter 'area' stands outside of a shape",
                                "an area emitter inside of the shape that shines");
    return;
  }
  for (AreaLight& light : area_lights(builder, shape, texture)) {
    refuse_as_beginning(light, p, builder);
    set_values(light.record.emission, radiance);
    // A light without power is never chosen.
    const double area = light.sampled ? double{light.record.area} : 0;
    const std::uint32_t index = builder.add_light(light.record, surface_power(area, radiance, light.bounds));
    for (const std::uint32_t primitive : light.primitives) {
      builder.set_light(shape, primitive, index);
      builder.surfaces_of(shape)[primitive].material_front |= kEmitsBit;
    }
  }
}

}  // namespace norrsken
