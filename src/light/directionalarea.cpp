// directionalarea: makes the shape that it stands in shine from its front, along its normals only.
//
// Parameters
//   radiance  color or texture, W / m^2, at least 0 (default 1)
// Neither a ray that meets the shape nor one that is sent to it comes along exactly that direction, so path, direct and
// whitted show nothing of its light: they say so. (In Mitsuba too only paths that begin at the lights find it.)
#include <fmt/format.h>

#include "compile/plugins.h"

namespace norrsken {

void compile_emitter_directionalarea(Parameters& p, Builder& builder, std::uint32_t shape) {
  const ColorParameter radiance = builder.color(p, "radiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  builder.describe(p.node(),
                   fmt::format("radiance {:.6g} {:.6g} {:.6g}", radiance.value.r, radiance.value.g, radiance.value.b));
  if (shape == kNone) {
    builder.diagnostics().error(p.node().plugin_location, "emitter 'directionalarea' stands outside of a shape",
                                "a directionalarea emitter inside of the shape that shines");
    return;
  }
  builder.diagnostics().warning(p.node().plugin_location,
                                "the light of emitter 'directionalarea' cannot be found by paths from the camera: it "
                                "adds nothing to the image");
}

}  // namespace norrsken
