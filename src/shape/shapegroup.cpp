// shapegroup: shapes that are only seen where an `instance` places them.
//
// Its geometry is stored once, however many instances there are. As in Mitsuba, a group holds neither groups nor
// instances, and its shapes cannot be lights.
#include <fmt/core.h>

#include "compile/shapes.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_shapegroup(Parameters& p, Shapes& shapes) {
  const std::size_t count = p.children("shape").size();
  if (shapes.in_group()) {
    p.diagnostics().error(p.node().location, "a shapegroup stands inside another one", "shapes with a surface");
  } else {
    shapes.describe(p.node(), fmt::format("{} shape{}", count, count == 1 ? "" : "s"));
    shapes.group(p.node());
  }
  ShapeGeometry nothing;
  nothing.of_shapes = true;
  return nothing;
}

}  // namespace norrsken
