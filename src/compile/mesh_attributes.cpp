#include "compile/mesh_attributes.h"

#include <algorithm>
#include <bit>

#include "base/text.h"

namespace norrsken {

void MeshAttributes::add(std::uint32_t shape, std::uint32_t first_vertex, std::uint32_t first_triangle,
                         std::span<const MeshAttribute> attributes) {
  for (const MeshAttribute& attribute : attributes) {
    const std::uint32_t first = attribute.per_face ? first_triangle : first_vertex;
    const auto offset = static_cast<std::uint32_t>(tables_.texels.size()) - first * attribute.channels;
    places_[attribute.name].push_back({shape, offset, attribute.channels, attribute.per_face});
    tables_.texels.insert(tables_.texels.end(), attribute.values.begin(), attribute.values.end());
  }
}

const std::set<std::string>& MeshAttributes::names_in(const Node& node) {
  if (const auto known = names_.find(&node); known != names_.end()) return known->second;
  std::set<std::string> names;
  if (node.plugin == "mesh_attribute") {
    for (const Property& property : node.properties) {
      const auto* name = std::get_if<std::string>(&property.value);
      if (name && property.name == "name") names.insert(*name);
    }
  }
  for (const Node::Child& child : node.children) names.merge(std::set(names_in(*child.node)));
  return names_[&node] = std::move(names);
}

void MeshAttributes::check(const Node& node, std::span<const MeshAttribute> attributes, Diagnostics& diagnostics) {
  for (const std::string& name : names_in(node)) {
    if (std::ranges::find(attributes, name, &MeshAttribute::name) != attributes.end()) continue;
    std::vector<std::string> known;
    for (const MeshAttribute& attribute : attributes) known.push_back(attribute.name);
    diagnostics.error(node.location,
                      "shape " + quoted(node.plugin) + " has no attribute " + quoted(name) + did_you_mean(name, known),
                      known.empty() ? "a mesh with attributes" : listed(known));
  }
}

void MeshAttributes::finish() {
  for (const auto& [name, offsets] : lookups_) {
    const auto table = static_cast<std::uint32_t>(tables_.texels.size());
    tables_.texels.resize(table + 2 * tables_.shapes.size(), 0.0f);
    if (const auto places = places_.find(name); places != places_.end()) {
      for (const Place& place : places->second) {
        float* words = tables_.texels.data() + table + 2 * std::size_t{place.shape};
        words[0] = std::bit_cast<float>(place.offset);
        words[1] = std::bit_cast<float>(place.channels | (place.per_face ? 4u : 0u));
      }
    }
    for (const std::uint32_t offset : offsets) tables_.parameters[offset] = std::bit_cast<float>(table);
  }
}

}  // namespace norrsken
