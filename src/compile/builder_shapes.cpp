// The builder's part that is about shapes, what they are made of, and lights.
#include <utility>

#include "base/text.h"
#include "compile/builder.h"
#include "compile/plugins.h"
#include "compile/within_memory.h"

namespace norrsken {

void Builder::compile_emitter(const Node& node, std::uint32_t shape) {
  const auto* plugin = find_plugin(emitter_plugins(), node, diagnostics_);
  if (!plugin) return;
  Parameters p = parameters(node);
  within_memory(node.location, "emitter " + quoted(node.plugin), diagnostics_,
                [&] { plugin->compile(p, *this, shape); });
  p.finish();
}

Material Builder::material_of(Parameters& shape) {
  if (const Node::Child* child = shape.child("bsdf")) return bsdf(*child->node);
  // Mitsuba's material for shapes that name none: lights are black, others grey.
  if (shape.child("emitter") != nullptr) return {};
  if (!default_material_)
    default_material_ =
        Material{.front = add_material(BsdfKind::diffuse, ParameterBlock().add(ColorParameter{glm::dvec3(0.5)}))};
  return *default_material_;
}

void Builder::compile_shape(const Node& node) {
  const auto* plugin = find_plugin(shape_plugins(), node, diagnostics_);
  if (!plugin) return;
  Parameters p = parameters(node);
  within_memory(p.has("filename") ? p.where("filename") : node.location, "shape " + quoted(node.plugin), diagnostics_,
                [&] { compile_shape(p, plugin->compile); });
}

void Builder::compile_shape(Parameters& p, std::optional<ShapeGeometry> (*compile)(Parameters&, Builder&)) {
  const Node& node = p.node();
  // An empty shape stands in for a broken one, so that its emitter's complaints are heard too.
  ShapeGeometry geometry = compile(p, *this).value_or(ShapeGeometry{});
  if (!geometry.of_shapes) {
    const Material material = material_of(p);
    const Node::Child* emitter = p.child("emitter");
    attributes_.check(node, geometry.mesh.attributes, diagnostics_);
    const std::vector<MeshAttribute> attributes = std::move(geometry.mesh.attributes);
    const auto first_vertex = static_cast<std::uint32_t>(tables().positions.size() / 3);
    const std::uint32_t first_triangle = tables().triangle_count();
    const std::uint32_t shape = geometry_.add(std::move(geometry), material);
    attributes_.add(shape, first_vertex, first_triangle, attributes);
    if (!node.id.empty()) {
      scene_.shape_ids.resize(shape + 1);
      scene_.shape_ids[shape] = node.id;
    }
    if (emitter && geometry_.in_group()) {
      diagnostics_.error(emitter->location, "an emitter stands inside a shapegroup, whose instances cannot shine",
                         "emitters on shapes of the scene itself");
    } else if (emitter) {
      compile_emitter(*emitter->node, shape);
    }
  }
  refuse_kinds_to_come(p);
  p.finish();
}

std::uint32_t Builder::shape_group(const Node& node) {
  if (const auto known = groups_.find(&node); known != groups_.end()) return known->second;
  Parameters p = parameters(node);
  geometry_.begin_group();
  const auto shapes = p.children("shape");
  if (shapes.empty()) diagnostics_.error(node.location, "the shapegroup has no shape", "<shape type=\"...\">");
  for (const Node::Child* child : shapes) compile_shape(*child->node);
  p.finish();
  return groups_[&node] = geometry_.end_group();
}

}  // namespace norrsken
