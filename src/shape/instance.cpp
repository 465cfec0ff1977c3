// instance: the shapes of a `shapegroup`, once more in another place.
//
// Parameters
//   (shape)       the shapegroup, usually by reference
//   to_world      transform (default identity) from the space of the group; any that is not singular
// Normals go through the inverse transpose of `to_world`, so a mirroring one does not turn surfaces inside out, as in
// Mitsuba.
#include <fmt/format.h>

#include "compile/plugins.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_instance(Parameters& p, Builder& builder) {
  ShapeGeometry nothing;
  nothing.of_shapes = true;
  const glm::dmat4 to_world = p.transform("to_world");
  const Node::Child* child = p.child("shape");
  constexpr const char* kAccepted = "<ref id=\"...\"/> to a shapegroup";
  if (builder.geometry().in_group()) {
    builder.diagnostics().error(p.node().location, "an instance stands inside a shapegroup", "shapes with a surface");
  } else if (child == nullptr) {
    builder.diagnostics().error(p.node().location, "the instance has no shapegroup", kAccepted);
  } else if (child->node->plugin != "shapegroup") {
    builder.diagnostics().error(child->location, fmt::format("an instance of a {}", child->node->plugin), kAccepted);
  } else if (!builder.geometry().add_instance(builder.shape_group(*child->node), to_world)) {
    p.error("to_world", "the instance is placed too far away or made too large",
            fmt::format("coordinates up to {:g}", kMaxCoordinate));
  } else {
    builder.describe(p.node(), child->node->id.empty() ? std::string() : fmt::format("of {}", child->node->id));
  }
  return nothing;
}

}  // namespace norrsken
