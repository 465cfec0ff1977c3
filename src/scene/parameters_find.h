// How Parameters asks for what is declared, and looks a property up by its types: for its own source files.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "base/text.h"
#include "scene/parameters.h"

namespace norrsken {

template <typename... Types>
const Property* Parameters::find_as(std::string_view name, std::string_view accepted) {
  const Property* property = find(name);
  if (property && (std::holds_alternative<Types>(property->value) || ... || false)) return property;
  if (property) {
    error(name, fmt::format("'{}' is {}", name, with_article(type_of(*property))), std::string(accepted));
    return nullptr;
  }
  if (const Node::Child* child = find_child(name))
    error(name, fmt::format("'{}' is {} here", name, with_article(child->node->kind)), std::string(accepted));
  return nullptr;
}

template <class Declared>
void Parameters::ask(const Declared& declared, PluginParameter::Type type, std::string fallback) {
  bool is_required = false;
  if constexpr (requires { declared.example; }) is_required = !declared.example.empty();
  if (record_) {
    PluginParameter& parameter = recorded(declared.name);
    parameter.type = type;
    parameter.text = declared.text;
    parameter.is_required = is_required;
    if constexpr (requires { declared.unit; }) parameter.unit = declared.unit;
    if constexpr (requires { declared.in_place_of; }) parameter.in_place_of = declared.in_place_of;
    if (!is_required && parameter.in_place_of.empty()) parameter.fallback = std::move(fallback);
  }
  asked_names_.emplace(declared.name);
  if constexpr (requires { declared.example; }) {
    if (is_required && !has(declared.name))
      error(declared.name, fmt::format("{} needs a parameter '{}'", name_of(node_), declared.name),
            std::string(declared.example));
  }
}

}  // namespace norrsken
