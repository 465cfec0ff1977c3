// The part of Parameters that is about what nobody asked for.
#include <fmt/format.h>

#include "base/text.h"
#include "scene/base_parameters.h"
#include "scene/parameters.h"

namespace norrsken {
namespace {

std::vector<std::string> list(const std::set<std::string, std::less<>>& words) { return {words.begin(), words.end()}; }

}  // namespace

void Parameters::accept_without_effect(const BaseParameter& parameter) {
  const int errors = diagnostics_.error_count();
  switch (parameter.type) {
    case BaseParameter::Type::boolean:
      read(BooleanParameter{.name = parameter.name});
      break;
    case BaseParameter::Type::integer:
      read(IntegerParameter{.name = parameter.name});
      break;
    case BaseParameter::Type::number:
      read(NumberParameter{.name = parameter.name});
      break;
    case BaseParameter::Type::transform:
      read(TransformParameter{.name = parameter.name});
      break;
  }
  if (diagnostics_.error_count() > errors) return;
  const std::string owner = parameter.plugin.empty() ? with_article(node_.kind) : name_of(node_);
  const std::string instead = parameter.instead.empty() ? "" : fmt::format(" (instead: {})", parameter.instead);
  diagnostics_.note(where(parameter.name),
                    fmt::format("'{}' of {} has no effect here{}", parameter.name, owner, instead));
}

void Parameters::finish() {
  const std::vector<std::string> names = list(asked_names_), kinds = list(asked_kinds_);
  // Only what is misspelt asks for it.
  const auto meant = [&](std::string_view name) {
    std::vector<std::string> known = names;
    for (const BaseParameter& row : base_parameters()) {
      if (find_base_parameter(node_.kind, node_.plugin, row.name)) known.emplace_back(row.name);
    }
    return did_you_mean(name, known);
  };
  const std::string none = "no parameters";
  for (const Property& property : node_.properties) {
    if (asked_names_.contains(property.name)) continue;
    if (const BaseParameter* base = find_base_parameter(node_.kind, node_.plugin, property.name)) {
      accept_without_effect(*base);
      continue;
    }
    diagnostics_.error(
        property.name_location,
        fmt::format("unused parameter {} of {}{}", quoted(property.file_name()), name_of(node_), meant(property.name)),
        names.empty() ? none : join(names));
  }
  for (const Node::Child& child : node_.children) {
    if (asked_kinds_.contains(child.node->kind) || (!child.name.empty() && asked_names_.contains(child.name))) continue;
    const std::string named = child.name.empty() ? "" : fmt::format(" named {}", quoted(child.name));
    const std::string accepted = kinds.empty() && !names.empty() ? "the names " + join(names) : join(kinds);
    diagnostics_.error(child.location,
                       fmt::format("unused {}{} in {}{}", name_of(*child.node), named, name_of(node_),
                                   child.name.empty() ? "" : meant(child.name)),
                       accepted.empty() ? "no children" : accepted);
  }
}

}  // namespace norrsken
