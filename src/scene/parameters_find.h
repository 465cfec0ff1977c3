// How Parameters looks a property up by its types: for its own source files.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <variant>

#include "base/text.h"
#include "scene/parameters.h"

namespace norrsken {

template <typename... Types>
const Property* Parameters::find_as(std::string_view name, std::string_view accepted) {
  const Property* property = find(name);
  if (property && (std::holds_alternative<Types>(property->value) || ...)) return property;
  if (property) {
    error(name, fmt::format("'{}' is {}", name, with_article(type_of(*property))), std::string(accepted));
    return nullptr;
  }
  if (const Node::Child* child = find_child(name))
    error(name, fmt::format("'{}' is {} here", name, with_article(child->node->kind)), std::string(accepted));
  return nullptr;
}

}  // namespace norrsken
