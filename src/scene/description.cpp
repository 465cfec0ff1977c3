#include "scene/description.h"

#include <algorithm>
#include <array>

#include "base/text.h"

namespace norrsken {
namespace {

/// In the order of Property::Value.
constexpr std::array<const char*, std::variant_size_v<Property::Value>> kTypes = {
    "boolean", "integer",   "float",       "string",      "rgb",  "spectrum",
    "vector",  "transform", "float array", "index array", "mesh", "image"};

}  // namespace

std::string type_of(const Property& property) {
  return property.type.empty() ? kTypes[property.value.index()] : property.type;
}

std::string name_of(const Node& node) {
  return node.plugin.empty() ? node.kind : node.kind + " " + quoted(node.plugin);
}

Node& Node::set(std::string property, Property::Value value) {
  const auto known = std::ranges::find(properties, property, &Property::name);
  if (known != properties.end()) {
    *known = {std::move(property), std::move(value)};
  } else {
    properties.push_back({std::move(property), std::move(value)});
  }
  return *this;
}

Node& Node::set(std::string property, FloatArray values) {
  return set(std::move(property), Property::Value(std::make_shared<const FloatArray>(std::move(values))));
}
Node& Node::set(std::string property, IndexArray values) {
  return set(std::move(property), Property::Value(std::make_shared<const IndexArray>(std::move(values))));
}
Node& Node::set(std::string property, Mesh mesh) {
  return set(std::move(property), Property::Value(std::make_shared<const Mesh>(std::move(mesh))));
}
Node& Node::set(std::string property, Image image) {
  return set(std::move(property), Property::Value(std::make_shared<const Image>(std::move(image))));
}

Node& Node::add(Node child, std::string as) {
  return add(std::make_shared<const Node>(std::move(child)), std::move(as));
}
Node& Node::add(std::shared_ptr<const Node> shared, std::string as) {
  if (shared) children.push_back({std::move(as), std::move(shared), {}});
  return *this;
}

}  // namespace norrsken
