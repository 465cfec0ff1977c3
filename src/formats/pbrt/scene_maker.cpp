#include "formats/pbrt/scene_maker.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "base/text.h"

namespace norrsken::pbrt {
namespace {

/// Of a node and what it holds in names and places, about.
constexpr std::size_t kNodeBytes = sizeof(Node) + 1024;

}  // namespace

void SceneMaker::add_shape(const std::string& type, Parameters p, SharedParameters alpha, const GraphicsState& state) {
  const bool is_interface = materials_.is_interface(state.material);
  std::shared_ptr<const AreaLight> light = state.area_light;
  if (light && (is_interface || in_object())) {
    context_.tell(p.place(), is_interface ? "lights on surfaces of material 'interface' are left out, as by pbrt"
                                          : "lights in objects are left out, as by pbrt");
    light = nullptr;
  }
  const Placement placement{
      .to_world = state.transforms.start,
      .reverse = state.reverse,
      .depends_on_uv = materials_.depends_on_uv(state.material) || !alpha.empty() || (light && light->image),
      .as_mesh = light && light->two_sided};
  if (const double determinant = glm::determinant(glm::dmat3(placement.to_world));
      !std::isfinite(determinant) || determinant == 0) {
    return p.error(nullptr, fmt::format("{} is placed where it has no volume", p.object()),
                   "a transform that can be undone");
  }
  context_.memory.grow(kNodeBytes);
  auto geometry = make_shape(context_, type, p, placement);
  p.find({"float", "texture"}, "alpha");
  p.finish();
  if (!geometry) return;
  Shape shape{.geometry = *std::move(geometry), .material = state.material, .light = std::move(light), .alpha = {}};
  if (!alpha.empty()) shape.alpha = Parameters(p.object(), p.place(), std::move(alpha), context_.diagnostics);
  (open_object_ ? open_object_->shapes : shapes_).push_back(std::move(shape));
}

bool SceneMaker::begin_object(const std::string& name, const Place& place) {
  const auto [object, is_new] = objects_.try_emplace(name);
  object->second.place = place;
  open_object_ = &object->second;
  return is_new;
}

void SceneMaker::add_instance(const std::string& name, const Place& place, const glm::dmat4& to_world) {
  context_.memory.grow(kNodeBytes);
  instances_.push_back({name, place, to_world});
}

std::shared_ptr<const Node> SceneMaker::surface_of(Shape& shape) {
  std::shared_ptr<const Node> surface = materials_.node(shape.material);
  if (!surface || !shape.alpha) return surface;
  Parameters& p = *shape.alpha;
  const Parameter* alpha = p.find({"float", "texture"}, "alpha");
  const std::string by = alpha->strings.empty() ? fmt::format("{}", alpha->numbers.empty() ? 1 : alpha->numbers[0])
                                                : "texture " + alpha->strings[0];
  std::shared_ptr<const Node>& mask = masks_[{surface.get(), by}];
  if (mask) return mask;
  const Pattern opacity = textures_.number(p, "alpha", 1);
  if (opacity.is_constant && opacity.value().r >= 1) return mask = surface;
  if (shape.light && opacity.is_constant && opacity.value().r == 0)
    context_.tell(alpha->place, "lights of alpha 0 cannot be hidden", "lights that are seen");
  Node node = make_node("bsdf", "mask", alpha->place);
  give_number(context_, node, "opacity", opacity, alpha->place);
  node.add(std::move(surface));
  return mask = std::make_shared<const Node>(std::move(node));
}

void SceneMaker::finish_shape(Shape& shape, Node& parent) {
  std::vector<Geometry> sides;
  if (shape.light && shape.light->two_sided) {
    sides = two_sides(context_, shape.geometry);
  } else {
    sides.push_back(std::move(shape.geometry));
  }
  const std::shared_ptr<const Node> surface = surface_of(shape);
  for (Geometry& geometry : sides) {
    if (shape.light) add_area_light(context_, *shape.light, geometry);
    geometry.node.add(surface);
    parent.add(std::move(geometry.node));
  }
}

void SceneMaker::finish_instances() {
  std::map<std::string, std::shared_ptr<const Node>> groups;
  for (auto& [name, object] : objects_) {
    Node group = make_node("shape", "shapegroup", object.place);
    for (Shape& shape : object.shapes) finish_shape(shape, group);
    groups[name] = object.shapes.empty() ? nullptr : std::make_shared<const Node>(std::move(group));
  }
  for (const Instance& instance : instances_) {
    const auto group = groups.find(instance.name);
    if (group == groups.end()) {
      std::vector<std::string> known;
      for (const auto& [name, object] : objects_) known.push_back(name);
      context_.diagnostics.error(
          instance.place.location(),
          fmt::format("there is no object {}{}", quoted(instance.name), did_you_mean(instance.name, known)),
          known.empty() ? "one that ObjectBegin begins" : listed(known));
    } else if (group->second) {
      Node node = make_node("shape", "instance", instance.place);
      give(node, "to_world", to_transform(instance.to_world), instance.place);
      node.add(group->second);
      scene_.add(std::move(node));
    }
  }
}

std::shared_ptr<const Node> SceneMaker::finish(Settings& settings) {
  add_settings(context_, settings, scene_);
  add_environment(context_, environment_, scene_);
  for (Shape& shape : shapes_) finish_shape(shape, scene_);
  finish_instances();
  materials_.finish();
  textures_.finish();
  return std::make_shared<const Node>(std::move(scene_));
}

}  // namespace norrsken::pbrt
