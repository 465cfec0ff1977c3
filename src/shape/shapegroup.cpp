// shapegroup: shapes that are only seen where an `instance` places them.
//
// Parameters
//   (shapes)      the members, each with its own placement in the space of the group
// Its geometry is stored once, however many instances there are. As in Mitsuba, a group holds neither groups nor
// instances, and its shapes cannot be lights.
#include <fmt/format.h>

#include "compile/plugins.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_shapegroup(Parameters& p, Builder& builder) {
  const std::size_t count = p.children("shape").size();
  if (builder.geometry().in_group()) {
    builder.diagnostics().error(p.node().location, "a shapegroup stands inside another one", "shapes with a surface");
  } else {
    builder.describe(p.node(), fmt::format("{} shape{}", count, count == 1 ? "" : "s"));
    builder.shape_group(p.node());
  }
  ShapeGeometry nothing;
  nothing.of_shapes = true;
  return nothing;
}

}  // namespace norrsken
