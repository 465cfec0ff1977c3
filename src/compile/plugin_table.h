// Looking a plugin up by name, with one wording for names that are misspelt and for those that are still to come.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/description.h"

namespace norrsken {

/// One line of a family's list: the `type` that a scene file writes, and the function that gives it its meaning.
template <class Function>
struct Plugin {
  std::string_view name;
  Function* compile;
};

/// Whether Mitsuba 3 documents a plugin `name` of this kind ("bsdf", "shape", ...).
bool is_mitsuba_plugin(std::string_view kind, std::string_view name);

/// "bsdf 'roughplastic' is not supported yet" or "unknown bsdf 'difuse', did you mean 'diffuse'?"
std::string complaint_about_plugin(const Node& node, const std::vector<std::string>& accepted);

/// Says so, with `accepted` sorted; points at the node's `type`.
void complain_about_plugin(const Node& node, std::vector<std::string> accepted, Diagnostics& diagnostics);

template <class Function>
const Plugin<Function>* find_plugin(std::span<const Plugin<Function>> table, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.name == name; });
  return found == table.end() ? nullptr : &*found;
}

template <class Function>
std::vector<std::string> names_of(std::span<const Plugin<Function>> table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  std::ranges::sort(names);
  return names;
}

/// The entry that `node` names, or nullptr after a complaint.
template <class Function>
const Plugin<Function>* find_plugin(std::span<const Plugin<Function>> table, const Node& node,
                                    Diagnostics& diagnostics) {
  const auto* found = find_plugin(table, node.plugin);
  if (!found) complain_about_plugin(node, names_of(table), diagnostics);
  return found;
}

}  // namespace norrsken
