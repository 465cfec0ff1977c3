#include "bsdf/resolved_host.h"

#include <fmt/core.h>

#include "base/text.h"

namespace norrsken {
namespace {

constexpr BooleanParameter kFlipInvalidNormals{
    .name = "flip_invalid_normals", .fallback = true, .text = "normals that turn away from the viewer are folded back"};
constexpr BooleanParameter kUseShadowing{
    .name = "use_shadowing_function", .fallback = true, .text = "softens the edge of the light on bumps"};

}  // namespace

std::vector<Material> nested_bsdfs(Parameters& p, Materials& materials, std::size_t count) {
  const auto inside = p.children("bsdf");
  std::vector<Material> found;
  found.reserve(inside.size());
  for (const Node::Child* child : inside) found.push_back(materials.inside(*child->node));
  if (inside.size() == count) return found;
  p.diagnostics().error(
      inside.size() > count ? inside[count]->location : p.node().location,
      fmt::format("bsdf {} has {} bsdf{} inside", quoted(p.node().plugin),
                  inside.empty() ? "no" : std::to_string(inside.size()), inside.size() == 1 ? "" : "s"),
      count == 1 ? "one bsdf" : "two bsdfs");
  return {};
}

std::optional<PerturbedSides> perturbed_slots(Parameters& p, Materials& materials) {
  std::uint32_t flags = p.read(kFlipInvalidNormals) ? kPerturbFlips : 0u;
  if (flags != 0 && materials.paths_begin_at_lights()) {
    p.diagnostics().warning(
        p.node().location,
        "normals that turn away are folded back by where the light is, where 'path' folds them by the viewer: with "
        "integrator 'ptracer' the image is another one, mostly brighter",
        "<boolean name=\"flip_invalid_normals\" value=\"false\"/>, or another integrator");
  }
  if (p.read(kUseShadowing)) flags |= kPerturbShadows;
  const auto inside = nested_bsdfs(p, materials, 1);
  if (inside.empty()) return std::nullopt;
  if (inside[0].maps == kMostMaps) {
    p.diagnostics().error(p.node().location,
                          fmt::format("{} bump and normal maps stand inside each other", kMostMaps + 1),
                          fmt::format("up to {}", kMostMaps));
    return std::nullopt;
  }
  materials.need_uv();
  return PerturbedSides{.front = {.inside = {inside[0].front, inside[0].back}, .flags = flags},
                        .back = {.inside = {inside[0].front, inside[0].back}, .flags = flags | kPerturbBack}};
}

}  // namespace norrsken
