#include "formats/ply_attributes.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace norrsken {
namespace {

constexpr std::string_view kGeometry[] = {"x", "y", "z", "nx", "ny",        "nz",        "u",
                                          "v", "s", "t", "a",  "texture_u", "texture_v", "alpha"};
constexpr std::array<std::string_view, 3> kColors[] = {{"r", "g", "b"}, {"red", "green", "blue"}};
/// Names of the components of one attribute, in order.
constexpr std::string_view kSchemes[] = {"xyzw", "rgba", "0123", "1234"};
constexpr std::string_view kColorScheme = kSchemes[1];

std::optional<std::size_t> find_property(const PlyElement& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (!element.properties[i].count_type && element.properties[i].name == name) return i;
  }
  return std::nullopt;
}

bool is_reserved(std::string_view name) {
  for (const auto& color : kColors) {
    if (std::find(color.begin(), color.end(), name) != color.end()) return true;
  }
  return std::find(std::begin(kGeometry), std::end(kGeometry), name) != std::end(kGeometry);
}

/// PREFIX and the one letter behind its last underscore; an empty prefix if the name is not of that form.
struct SplitName {
  std::string_view prefix;
  char component = 0;
};
SplitName split(const PlyProperty& property) {
  const std::string_view name = property.name;
  const std::size_t underscore = name.rfind('_');
  if (property.count_type || is_reserved(name) || underscore == std::string_view::npos || underscore + 2 != name.size())
    return {};
  return {name.substr(0, underscore), name.back()};
}

/// The scheme that begins with this component.
std::string_view scheme_of(char component) {
  for (const std::string_view scheme : kSchemes) {
    if (scheme.front() == component) return scheme;
  }
  return {};
}

}  // namespace

std::vector<PlyAttribute> find_ply_attributes(const PlyElement& element, std::string_view owner) {
  std::vector<PlyAttribute> attributes;
  std::set<std::string> names;
  const auto add = [&](std::string name, std::vector<std::size_t> properties) {
    if (names.insert(name).second) attributes.push_back({std::move(name), std::move(properties)});
  };
  for (const auto& [r, g, b] : kColors) {
    const auto ir = find_property(element, r), ig = find_property(element, g), ib = find_property(element, b);
    if (ir && ig && ib) add(std::string(owner) + "color", {*ir, *ig, *ib});
  }
  for (std::size_t first = 0; first < element.properties.size();) {
    const SplitName start = split(element.properties[first]);
    const std::string_view scheme = scheme_of(start.component);
    std::vector<std::size_t> group{first};
    while (!start.prefix.empty() && group.size() < scheme.size() && group.back() + 1 < element.properties.size()) {
      const SplitName next = split(element.properties[group.back() + 1]);
      if (next.prefix != start.prefix || next.component != scheme[group.size()]) break;
      group.push_back(group.back() + 1);
    }
    first = group.back() + 1;
    if (start.prefix.empty() || scheme.empty() || (group.size() != 1 && group.size() != 3)) continue;
    add(std::string(owner).append(start.prefix) + (scheme == kColorScheme ? "_color" : ""), std::move(group));
  }
  return attributes;
}

}  // namespace norrsken
