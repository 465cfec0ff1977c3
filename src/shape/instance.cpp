// instance: the shapes of a `shapegroup`, once more in another place.
//
// Normals go through the inverse transpose of `to_world`, so a mirroring one does not turn surfaces inside out, as in
// Mitsuba.
#include <fmt/core.h>

#include "compile/shapes.h"

namespace norrsken {
namespace {

constexpr TransformParameter kToWorld{.name = "to_world",
                                      .text = "from the space of the group; any that is not singular"};

}  // namespace

std::optional<ShapeGeometry> compile_shape_instance(Parameters& p, Shapes& shapes) {
  ShapeGeometry nothing;
  nothing.of_shapes = true;
  const glm::dmat4 to_world = p.read(kToWorld);
  const Node::Child* child = p.child("shape");
  constexpr const char* kAccepted = "<ref id=\"...\"/> to a shapegroup";
  if (shapes.in_group()) {
    p.diagnostics().error(p.node().location, "an instance stands inside a shapegroup", "shapes with a surface");
  } else if (child == nullptr) {
    p.diagnostics().error(p.node().location, "the instance has no shapegroup", kAccepted);
  } else if (child->node->plugin != "shapegroup") {
    p.diagnostics().error(child->location, fmt::format("an instance of a {}", child->node->plugin), kAccepted);
  } else if (!shapes.add_instance(shapes.group(*child->node), to_world)) {
    p.error(kToWorld.name, "the instance is placed too far away or made too large",
            fmt::format("coordinates up to {:g}", kMaxCoordinate));
  } else {
    shapes.describe(p.node(), child->node->id.empty() ? std::string() : fmt::format("of {}", child->node->id));
  }
  return nothing;
}

}  // namespace norrsken
