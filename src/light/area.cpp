// area: makes the shape that it stands in shine from its front, alike in all directions.
//
// One light per triangle, sphere, disk and cylinder; two triangles of a shape that make a parallelogram are one light, so
// that it is chosen and sampled as a whole. The front is that of the geometric normal (in
// Mitsuba of the shading normal): normals that a coarse mesh is smoothed by change nothing about where it shines to.
#include <fmt/core.h>

#include "light/area_host.h"
#include "light/light_host.h"

namespace norrsken {

void compile_emitter_area(Parameters& p, Lights& lights, std::uint32_t shape) {
  const ColorOrTexture given = lights.read(p, kUniformRadiance);
  const glm::dvec3 radiance = given.rgb();
  lights.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
  if (shape == kNone) {
    p.diagnostics().error(p.node().plugin_location, "emitter 'area' stands outside of a shape",
                          "an area emitter inside of the shape that shines");
    return;
  }
  for (AreaLight& light : area_lights(lights, shape, given.texture)) {
    refuse_as_beginning(light, p, lights);
    set_values(light.record.emission, radiance);
    // A light without power is never chosen.
    const double area = light.sampled ? double{light.record.area} : 0;
    const std::uint32_t index = lights.add(light.record, surface_power(area, radiance, light.bounds));
    for (const std::uint32_t primitive : light.primitives) {
      lights.set_light(shape, primitive, index);
      lights.surfaces_of(shape)[primitive].material_front |= kEmitsBit;
    }
  }
}

}  // namespace norrsken
