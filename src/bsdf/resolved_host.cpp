#include "bsdf/resolved_host.h"

#include <fmt/format.h>

#include <set>

#include "base/text.h"

namespace norrsken {
namespace {

/// A map among the BSDFs inside of `node`; each node is looked at once, however many lead to it.
const Node* find_map(const Node& node, std::set<const Node*>& seen) {
  for (const Node::Child& child : node.children) {
    if (child.node->kind != "bsdf" || !seen.insert(child.node.get()).second) continue;
    if (perturbs_bsdf(child.node->plugin)) return child.node.get();
    if (const Node* found = find_map(*child.node, seen)) return found;
  }
  return nullptr;
}

}  // namespace

std::vector<Material> nested_bsdfs(Parameters& p, Builder& builder, std::size_t count) {
  const auto inside = p.children("bsdf");
  std::vector<Material> materials;
  materials.reserve(inside.size());
  for (const Node::Child* child : inside) materials.push_back(builder.bsdf(*child->node));
  if (inside.size() == count) return materials;
  builder.diagnostics().error(
      inside.size() > count ? inside[count]->location : p.node().location,
      fmt::format("bsdf {} has {} bsdf{} inside", quoted(p.node().plugin),
                  inside.empty() ? "no" : std::to_string(inside.size()), inside.size() == 1 ? "" : "s"),
      count == 1 ? "one bsdf" : "two bsdfs");
  return {};
}

std::optional<PerturbedBlocks> perturbed_blocks(Parameters& p, Builder& builder) {
  std::uint32_t flags = p.boolean("flip_invalid_normals", true) ? 1u : 0u;
  if (p.boolean("use_shadowing_function", true)) flags |= 2u;
  std::set<const Node*> seen;
  if (const Node* map = find_map(p.node(), seen)) {
    builder.diagnostics().error(
        map->location,
        fmt::format("bsdf {} inside of bsdf {} is not supported yet", quoted(map->plugin), quoted(p.node().plugin)),
        "one bump or normal map");
    p.children("bsdf");
    return std::nullopt;
  }
  const auto inside = nested_bsdfs(p, builder, 1);
  if (inside.empty()) return std::nullopt;
  builder.need_uv();
  PerturbedBlocks blocks;
  blocks.front.add_word(inside[0].front).add_word(flags);
  blocks.back.add_word(inside[0].back).add_word(flags);
  return blocks;
}

}  // namespace norrsken
