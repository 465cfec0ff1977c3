#include "scene/parameters.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "scene/constant_spectrum.h"

namespace norrsken {

Parameters::Parameters(const Node& node, const Description& description, const FileSystem& files,
                       Diagnostics& diagnostics)
    : node_(node), description_(description), files_(files), diagnostics_(diagnostics) {}

bool Parameters::has(std::string_view name) const {
  const auto named = [name](const auto& item) { return item.name == name; };
  return std::any_of(node_.properties.begin(), node_.properties.end(), named) ||
         std::any_of(node_.children.begin(), node_.children.end(), named) ||
         std::find(node_.unreadable.begin(), node_.unreadable.end(), name) != node_.unreadable.end();
}

const Property* Parameters::find(std::string_view name) {
  asked_names_.emplace(name);
  const auto named = [name](const Property& property) { return property.name == name; };
  const auto found = std::find_if(node_.properties.begin(), node_.properties.end(), named);
  return found == node_.properties.end() ? nullptr : &*found;
}

const Node::Child* Parameters::find_child(std::string_view name) const {
  const auto named = [name](const Node::Child& child) { return child.name == name; };
  const auto found = std::find_if(node_.children.begin(), node_.children.end(), named);
  return found == node_.children.end() ? nullptr : &*found;
}

const Node::Child* Parameters::texture(std::string_view name) {
  if (record_) recorded(name).may_be_texture = true;
  const Node::Child* child = find_child(name);
  if (!child || !is_spectrum_or_texture(*child->node) || is_constant_spectrum(*child->node)) return nullptr;
  asked_names_.emplace(name);
  return child;
}

const Node::Child* Parameters::volume(std::string_view name) {
  if (record_) recorded(name).may_be_volume = true;
  const Node::Child* child = find_child(name);
  if (!child || child->node->kind != "volume") return nullptr;
  asked_names_.emplace(name);
  return child;
}

std::vector<const Node::Child*> Parameters::children(std::string_view kind) {
  asked_kinds_.emplace(kind);
  if (record_ && std::ranges::find(record_->children, kind) == record_->children.end())
    record_->children.emplace_back(kind);
  std::vector<const Node::Child*> found;
  for (const Node::Child& child : node_.children) {
    if (child.node->kind == kind) found.push_back(&child);
  }
  return found;
}

const Node::Child* Parameters::child(std::string_view kind) {
  const auto found = children(kind);
  if (found.size() > 1)
    diagnostics_.error(found[1]->location, fmt::format("{} has more than one {}", name_of(node_), kind),
                       fmt::format("one {}", kind));
  return found.empty() ? nullptr : found[0];
}

PluginParameter& Parameters::recorded(std::string_view name) {
  auto& parameters = record_->parameters;
  const auto known = std::ranges::find(parameters, name, &PluginParameter::name);
  if (known != parameters.end()) return *known;
  PluginParameter& added = parameters.emplace_back();
  added.name = name;
  return added;
}

void Parameters::note_range(std::string_view name, const Range& range) {
  if (!record_) return;
  PluginParameter& parameter = recorded(name);
  // Bounds that only say what the program can calculate with are none.
  if (range.min > -kMaxCoordinate) parameter.min = range.min;
  if (range.max < kMaxCoordinate) parameter.max = range.max;
  parameter.min_belongs = range.ends == Ends::closed, parameter.max_belongs = range.ends != Ends::open;
}

SourceLocation Parameters::where(std::string_view name) const {
  for (const Property& property : node_.properties) {
    if (property.name == name) return property.location;
  }
  for (const Node::Child& child : node_.children) {
    if (child.name == name) return child.location;
  }
  return node_.location;
}

void Parameters::error(std::string_view name, std::string message, std::string accepted) {
  diagnostics_.error(where(name), std::move(message), std::move(accepted));
}

}  // namespace norrsken
