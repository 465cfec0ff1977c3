// The builder's part that is about what textures have to give, and what they need.
#include <fmt/format.h>

#include "base/text.h"
#include "compile/builder.h"
#include "scene/constant_spectrum.h"

namespace norrsken {

Texture Builder::within_range(Parameters& p, std::string_view name, const Texture& texture, const Range& range) {
  const double min = range.min, max = range.max;
  if (!(texture.min < min || texture.max > max)) return texture;
  const std::string found = fmt::format("'{}' has values from {:g} to {:g}", name, texture.min, texture.max);
  if (!texture.clamped) {
    p.error(name, found,
            max < std::numeric_limits<double>::infinity()
                ? fmt::format("a texture with values from {:g} to {:g}", min, max)
                : fmt::format("a texture with values of at least {:g}", min));
    return texture;
  }
  const auto [known, is_new] = clamped_textures_.try_emplace({texture.word, min, max});
  if (is_new) {
    const std::string below = fmt::format("below {:g} are taken for {:g}", min, min),
                      above = fmt::format("above {:g} for {:g}", max, max);
    diagnostics_.warning(p.where(name),
                         found + ": those " +
                             (texture.max <= max   ? below
                              : texture.min >= min ? fmt::format("above {:g} are taken for {:g}", max, max)
                                                   : below + ", those " + above));
    known->second = texture.clamped(min, max, p.where(name));
  }
  return known->second;
}

const Node* Builder::texture_by_uv(const Node& node) {
  if (const auto known = textures_by_uv_.find(&node); known != textures_by_uv_.end()) return known->second;
  const Node* found = nullptr;
  if (is_spectrum_or_texture(node) && node.plugin != "mesh_attribute" && !is_constant_spectrum(node)) found = &node;
  for (const Node::Child& child : node.children) {
    if (found == nullptr) found = texture_by_uv(*child.node);
  }
  return textures_by_uv_[&node] = found;
}

void Builder::want_texcoords(const Node& shape) {
  const Node* texture = texture_by_uv(shape);
  if (texture == nullptr) return;
  diagnostics_.warning(shape.location,
                       fmt::format("shape {} has no texture coordinates: texture {} ({}:{}:{}) is drawn anew on every "
                                   "triangle",
                                   quoted(shape.plugin), quoted(texture->plugin), texture->location.file,
                                   texture->location.line, texture->location.column));
}

}  // namespace norrsken
