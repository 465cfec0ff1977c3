#include "formats/pbrt/context.h"

#include "scene/find_file.h"

namespace norrsken::pbrt {

std::string Context::find_file(const Parameter& parameter) const {
  return parameter.strings.empty() ? std::string() : find_file(parameter, parameter.strings[0]);
}

std::string Context::find_file(const Parameter& parameter, const std::string& name) const {
  return norrsken::find_file(files, name, folders, parameter.value.location(), {}, diagnostics);
}

void give(Node& node, std::string name, Property::Value value, const Place& place) {
  node.set(name, std::move(value));
  for (Property& property : node.properties) {
    if (property.name == name) property.location = property.name_location = place.location();
  }
}

Node make_node(std::string kind, std::string plugin, const Place& place) {
  Node node(std::move(kind), std::move(plugin));
  node.location = node.plugin_location = place.location();
  return node;
}

void add_child(Node& parent, std::shared_ptr<const Node> child, std::string as, const Place& place) {
  parent.children.push_back({std::move(as), std::move(child), place.location()});
}

}  // namespace norrsken::pbrt
