// normalmap: host side.
//
// Parameters
//   normalmap               texture or color (required): normals in the shading frame, x, y, z from -1 to 1 as colours
//                           from 0 to 1. A bitmap wants `raw`
//   flip_invalid_normals    boolean (default true): normals that turn away from the viewer are folded back
//   use_shadowing_function  boolean (default true): softens the edge of the light on bumps
// Children
//   bsdf                    one: what has these normals; up to 4 bump and normal maps may stand inside each other, each in the
//                           frame that the one around it makes
// Stored, for each side: the words inside, flags, the normal map (4 floats).
#include <limits>

#include "bsdf/resolved_host.h"

namespace norrsken {

Material compile_bsdf_normalmap(Parameters& p, Builder& builder) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  p.require("normalmap", "<texture name=\"normalmap\" type=\"bitmap\">");
  const ColorParameter normals = builder.color(p, "normalmap", glm::dvec3(0.5, 0.5, 1), -kAny, kAny);
  auto blocks = perturbed_blocks(p, builder);
  builder.describe(p.node(), {});
  if (!blocks) return {};
  return {.front = builder.add_material(BsdfKind::normalmap, blocks->front.add(normals)),
          .back = builder.add_material(BsdfKind::normalmap, blocks->back.add(normals))};
}

}  // namespace norrsken
