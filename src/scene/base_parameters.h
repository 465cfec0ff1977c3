// Parameters that the format's plugins take and that mean nothing here: most are read by the base class of a family, so
// that every plugin of it takes them, needed or not.
#pragma once

#include <span>
#include <string_view>

namespace norrsken {

struct BaseParameter {
  enum class Type { boolean, integer, number, transform };
  std::string_view kind;
  std::string_view plugin;  ///< empty: every plugin of the kind
  std::string_view name;
  Type type;
  std::string_view instead;  ///< what has that effect here; may be empty
};

std::span<const BaseParameter> base_parameters();

/// The row for parameter `name` of this plugin, or nullptr.
const BaseParameter* find_base_parameter(std::string_view kind, std::string_view plugin, std::string_view name);

}  // namespace norrsken
