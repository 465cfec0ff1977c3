// directionalarea: makes the shape that it stands in shine from its front, along its normals only; where a mesh has
// vertex normals, along those.
//
// Parameters
//   radiance  color or texture, W / m^2, at least 0 (default 1)
// Neither a ray that meets the shape nor one that is sent to it comes along exactly that direction, so only ptracer, whose
// paths begin at the lights, finds its light; path, direct and whitted show nothing of it and say so. The shape itself is
// as its bsdf has it: black if it names none.
#include <fmt/format.h>

#include "compile/plugins.h"
#include "light/area_host.h"
#include "light/light_host.h"

namespace norrsken {
namespace {

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

void compile_emitter_directionalarea(Parameters& p, Builder& builder, std::uint32_t shape) {
  const auto [radiance, texture] = builder.color(p, "radiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  builder.describe(p.node(), fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.r, radiance.g, radiance.b));
  if (shape == kNone) {
    builder.diagnostics().error(p.node().plugin_location, "emitter 'directionalarea' stands outside of a shape",
                                "a directionalarea emitter inside of the shape that shines");
    return;
  }
  const bool found = builder.paths_begin_at_lights();
  if (!found) {
    builder.diagnostics().warning(p.node().plugin_location,
                                  "the light of emitter 'directionalarea' cannot be found by paths from the camera: it "
                                  "adds nothing to the image",
                                  "integrator 'ptracer', whose paths begin at the lights");
  }
  for (AreaLight& light : area_lights(builder, shape, texture, /*along_normals=*/true)) {
    refuse_as_beginning(light, p, builder);
    set_values(light.record.emission, radiance);
    light.record.kind = along_normals(light.record.kind);
    // A light without power is never chosen.
    const double area = found && light.sampled ? double{light.record.area} : 0;
    const std::uint32_t index = builder.add_light(light.record, beam_power(area, radiance));
    // It counts as an emitter, which cameras may be told to look through; but no ray sees it shine.
    for (const std::uint32_t primitive : light.primitives) builder.set_light(shape, primitive, index);
  }
}

}  // namespace norrsken
