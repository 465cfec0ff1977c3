// What the upgrade of old scenes does to nodes, as small steps.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/description.h"

namespace norrsken::upgrade {

/// Whether `word` is one of those in a list that is apart by blanks; all are in "*".
inline bool is_among(std::string_view word, std::string_view list) {
  if (list == "*") return true;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (list.substr(0, end) == word) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

inline const Property* find(const Node& node, std::string_view name) {
  const auto found = std::ranges::find(node.properties, name, &Property::name);
  return found == node.properties.end() ? nullptr : &*found;
}

/// Whether the node was given that parameter, well or not.
inline bool has(const Node& node, std::string_view name) {
  return find(node, name) || std::ranges::any_of(node.children, [&](const auto& c) { return c.name == name; }) ||
         std::ranges::find(node.unreadable, name) != node.unreadable.end();
}

inline void remove(Node& node, std::string_view name) {
  std::erase_if(node.properties, [name](const Property& property) { return property.name == name; });
}

/// Of a float or an integer; 0 if it is neither.
inline double number_of(const Property& property) {
  if (const auto* real = std::get_if<double>(&property.value)) return *real;
  const auto* integer = std::get_if<std::int64_t>(&property.value);
  return integer ? static_cast<double>(*integer) : 0;
}

inline std::string text_of(const Property& property) {
  const auto* text = std::get_if<std::string>(&property.value);
  return text ? *text : std::string();
}

/// Multiplies a number, a colour or a spectrum.
inline void multiply(Property& property, double factor) {
  if (auto* rgb = std::get_if<Property::Rgb>(&property.value)) {
    for (double& component : rgb->value) component *= factor;
  } else if (auto* spectrum = std::get_if<Property::Spectrum>(&property.value)) {
    for (auto& sample : spectrum->samples) sample.second *= factor;
  } else {
    property.value = factor * number_of(property);
  }
}

/// A property that the file does not have; complaints about it point at the node's type.
inline void add_property(Node& node, std::string name, std::string type, Property::Value value) {
  Property property;
  property.name = std::move(name);
  property.type = std::move(type);
  property.value = std::move(value);
  property.location = property.name_location = node.plugin_location;
  node.properties.push_back(std::move(property));
}

/// Their places among the children.
inline std::vector<std::size_t> children_of_kind(const Node& node, std::string_view kind) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    if (node.children[i].node && node.children[i].node->kind == kind) places.push_back(i);
  }
  return places;
}

/// Turns `node` into what `inner`, a child of it, is; what refers to it goes on to do so.
inline void become(Node& node, const Node& inner) {
  Node copy = inner;
  node.plugin = std::move(copy.plugin);
  node.plugin_location = std::move(copy.plugin_location);
  node.properties = std::move(copy.properties);
  node.unreadable = std::move(copy.unreadable);
  node.children = std::move(copy.children);
}

}  // namespace norrsken::upgrade
