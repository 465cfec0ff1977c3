#include "compile/scene_children.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/numbers.h"
#include "base/text.h"

namespace norrsken {
namespace {

bool is_light_of_a_shape(const Node& emitter) {
  return emitter.plugin == "area" || emitter.plugin == "directionalarea";
}

void warn_of_unused(const Node& node, Diagnostics& diagnostics) {
  diagnostics.warning(node.location, fmt::format("nothing refers to {} {}, which has no effect by itself", node.kind,
                                                 quoted(node.plugin)));
}

std::string describe_sensors(const std::vector<const Node::Child*>& sensors) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::string word = word_for_sensor(sensors, i);
    const std::string& id = sensors[i]->node->id;
    words.push_back(id.empty() || id == word ? word : fmt::format("{} or {}", word, id));
  }
  return listed(words);
}

}  // namespace

std::vector<const Node*> nodes_below(std::vector<const Node*> open) {
  std::vector<const Node*> nodes;
  std::set<const Node*> walked;
  std::ranges::reverse(open);
  while (!open.empty()) {
    const Node& node = *open.back();
    open.pop_back();
    if (!walked.insert(&node).second) continue;
    nodes.push_back(&node);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) open.push_back(child->node.get());
  }
  return nodes;
}

Description with_sensors_of_shapes(Description description) {
  const auto is_sensor = [](const Node::Child& child) { return child.node->kind == "sensor"; };
  const auto has_sensor = [&](const Node::Child& child) {
    return child.node->kind == "shape" && std::ranges::any_of(child.node->children, is_sensor);
  };
  if (!description.scene || std::ranges::none_of(description.scene->children, has_sensor)) return description;
  auto scene = std::make_shared<Node>(*description.scene);
  scene->children.clear();
  for (const Node::Child& child : description.scene->children) {
    scene->children.push_back(child);
    if (!has_sensor(child)) continue;
    for (const Node::Child& inside : child.node->children) {
      if (!is_sensor(inside)) continue;
      auto sensor = std::make_shared<Node>(*inside.node);
      if (sensor->plugin == "irradiancemeter") sensor->add(child.node);
      scene->children.push_back({inside.name, std::move(sensor), inside.location});
    }
  }
  description.scene = std::move(scene);
  return description;
}

std::set<const Node*> nodes_inside_of_others(const Node& scene) {
  std::set<const Node*> inside;
  for (const Node* node : nodes_below({&scene})) {
    if (node == &scene) continue;
    for (const Node::Child& child : node->children) inside.insert(child.node.get());
  }
  return inside;
}

std::set<const Node*> nodes_in_use(const Node& scene) {
  std::vector<const Node*> roots;
  for (const Node::Child& child : scene.children) {
    const Node& node = *child.node;
    const bool is_part = node.kind == "sensor" || node.kind == "integrator" || node.kind == "emitter" ||
                         (node.kind == "shape" && node.plugin != "shapegroup");
    if (is_part) roots.push_back(&node);
  }
  const std::vector<const Node*> used = nodes_below(std::move(roots));
  return {used.begin(), used.end()};
}

void take_definitions(Parameters& scene, const std::set<const Node*>& inside) {
  for (const char* kind : {"film", "medium", "phase", "rfilter", "sampler", "volume"}) {
    for (const Node::Child* child : scene.children(kind)) {
      if (!inside.contains(child->node.get())) warn_of_unused(*child->node, scene.diagnostics());
    }
  }
}

const Node::Child* integrator_of_scene(Parameters& scene, const std::set<const Node*>& inside) {
  auto integrators = scene.children("integrator");
  std::erase_if(integrators, [&](const Node::Child* child) { return inside.contains(child->node.get()); });
  if (integrators.size() > 1)
    scene.diagnostics().error(integrators[1]->location, "scene has more than one integrator", "one integrator");
  return integrators.empty() ? nullptr : integrators[0];
}

std::vector<const Node*> emitters_of_scene(Parameters& scene, const std::set<const Node*>& inside) {
  std::vector<const Node*> emitters;
  for (const Node::Child* child : scene.children("emitter")) {
    const Node& node = *child->node;
    if (!is_light_of_a_shape(node) || (node.id.empty() && !inside.contains(&node))) {
      emitters.push_back(&node);
    } else if (!inside.contains(&node)) {
      warn_of_unused(node, scene.diagnostics());
    }
  }
  return emitters;
}

const Node* choose_sensor(Parameters& scene, const std::optional<std::string>& choice, bool tell_of_others) {
  const std::vector<const Node::Child*> sensors = scene.children("sensor");
  if (!choice) {
    if (sensors.empty()) return nullptr;
    for (std::size_t i = 1; tell_of_others && i < sensors.size(); ++i) {
      scene.diagnostics().warning(sensors[i]->location, "only the scene's first sensor is used, this one is left aside",
                                  fmt::format("--sensor {} for this one", word_for_sensor(sensors, i)));
    }
    return sensors[0]->node.get();
  }
  const auto named = std::ranges::find_if(sensors, [&](const auto* sensor) { return sensor->node->id == *choice; });
  if (!choice->empty() && named != sensors.end()) return (*named)->node.get();
  std::int64_t number = -1;
  if (parse_integer(*choice, number) == NumberStatus::ok && number >= 0 &&
      number < static_cast<std::int64_t>(sensors.size()))
    return sensors[static_cast<std::size_t>(number)]->node.get();
  std::vector<std::string> ids;
  for (const Node::Child* sensor : sensors) ids.push_back(sensor->node->id);
  scene.diagnostics().error(
      {}, fmt::format("--sensor: the scene has no sensor {}{}", quoted(*choice), did_you_mean(*choice, ids)),
      sensors.empty() ? "no --sensor: the scene has none" : describe_sensors(sensors));
  return nullptr;
}

std::string word_for_sensor(const std::vector<const Node::Child*>& sensors, std::size_t number) {
  const std::string word = std::to_string(number), &own = sensors[number]->node->id;
  const auto first = std::ranges::find_if(sensors, [&](const auto* sensor) { return sensor->node->id == word; });
  const bool is_taken = first != sensors.end() && *first != sensors[number];
  return is_taken && !own.empty() ? own : word;
}

}  // namespace norrsken
