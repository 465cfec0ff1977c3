#include "bsdf/resolved_host.h"

#include <fmt/format.h>

#include "base/text.h"

namespace norrsken {

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
  std::uint32_t flags = p.boolean("flip_invalid_normals", true) ? kPerturbFlips : 0u;
  if (flags != 0 && builder.tables().integrator.from_lights) {
    builder.diagnostics().warning(
        p.node().location,
        "normals that turn away are folded back by where the light is, where 'path' folds them by the viewer: with "
        "integrator 'ptracer' the image is another one, mostly brighter",
        "<boolean name=\"flip_invalid_normals\" value=\"false\"/>, or another integrator");
  }
  if (p.boolean("use_shadowing_function", true)) flags |= kPerturbShadows;
  const auto inside = nested_bsdfs(p, builder, 1);
  if (inside.empty()) return std::nullopt;
  if (inside[0].maps == kMostMaps) {
    builder.diagnostics().error(p.node().location,
                                fmt::format("{} bump and normal maps stand inside each other", kMostMaps + 1),
                                fmt::format("up to {}", kMostMaps));
    return std::nullopt;
  }
  builder.need_uv();
  PerturbedBlocks blocks;
  for (ParameterBlock* block : {&blocks.front, &blocks.back}) block->add_word(inside[0].front).add_word(inside[0].back);
  blocks.front.add_word(flags);
  blocks.back.add_word(flags | kPerturbBack);
  return blocks;
}

}  // namespace norrsken
