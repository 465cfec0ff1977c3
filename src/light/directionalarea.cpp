// directionalarea: makes the shape that it stands in shine from its front, along its normals only; where a mesh has
// vertex normals, along those.
//
// Neither a ray that meets the shape nor one that is sent to it comes along exactly that direction, so only ptracer, whose
// paths begin at the lights, finds its light; path, direct and whitted show nothing of it and say so. The shape itself is
// as its bsdf has it: black if it names none.
#include <fmt/core.h>

#include "light/area_host.h"
#include "light/light_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kRadiance{
    .name = "radiance", .fallback = 1, .range = {0, kMaxEmission}, .text = "", .unit = "W / m^2", .of = ColorOf::light};

LightKind along_normals(LightKind kind) {
  switch (kind) {
    case LightKind::triangle:
      return LightKind::triangle_normals;
    case LightKind::parallelogram:
      return LightKind::parallelogram_normals;
    case LightKind::sphere:
      return LightKind::sphere_normals;
    default:
      return LightKind::analytic_normals;
  }
}

}  // namespace

void compile_emitter_directionalarea(Parameters& p, Lights& lights, std::uint32_t shape) {
  const ColorOrTexture given = lights.read(p, kRadiance);
  const glm::dvec3 radiance = given.rgb();
  lights.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
  if (shape == kNone) {
    p.diagnostics().error(p.node().plugin_location, "emitter 'directionalarea' stands outside of a shape",
                          "a directionalarea emitter inside of the shape that shines");
    return;
  }
  const bool found = lights.paths_begin_at_lights();
  if (!found) {
    p.diagnostics().warning(p.node().plugin_location,
                            "the light of emitter 'directionalarea' cannot be found by paths from the camera: it "
                            "adds nothing to the image",
                            "integrator 'ptracer', whose paths begin at the lights");
  }
  for (AreaLight& light : area_lights(lights, shape, given.texture, /*along_normals=*/true)) {
    refuse_as_beginning(light, p, lights);
    set_values(light.record.emission, radiance);
    light.record.kind = along_normals(light.record.kind);
    // A light without power is never chosen.
    const double area = found && light.sampled ? double{light.record.area} : 0;
    const std::uint32_t index = lights.add(light.record, beam_power(area, radiance));
    // It counts as an emitter, which cameras may be told to look through; but no ray sees it shine.
    for (const std::uint32_t primitive : light.primitives) lights.set_light(shape, primitive, index);
  }
}

}  // namespace norrsken
