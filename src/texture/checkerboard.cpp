// checkerboard: host side.
//
// Where it stands for a number, such as a roughness, that is the mean of a colour, and the two change places: so do
// Mitsuba's images show it.
#include "texture/checkerboard.h"

#include <fmt/core.h>

#include <algorithm>

#include "compile/textures.h"
#include "texture/texture_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kColor0{
    .name = "color0", .fallback = 0.4, .text = "where both coordinates are in the same half of their unit"};
constexpr ColorParameter kColor1{.name = "color1", .fallback = 0.2, .text = "elsewhere"};

/// A colour, or the texture in its place: both as textures are told of.
struct Square {
  ColorSlot color, number;
  glm::dvec3 mean;
  double min, max;
};

Square read_square(Parameters& p, Textures& textures, const ColorParameter& parameter) {
  const auto slot = [](const glm::dvec3& c, TextureWord word) {
    const glm::vec3 v(c);
    return ColorSlot{{v.x, v.y, v.z}, word};
  };
  const auto grey = [](const glm::dvec3& c) { return glm::dvec3((c.x + c.y + c.z) / 3); };
  const Node::Child* child = p.texture(parameter.name);
  if (child == nullptr) {
    const glm::dvec3 c = p.read(parameter).rgb();
    return {slot(c, 0), slot(grey(c), 0), c, std::min({c.x, c.y, c.z}), std::max({c.x, c.y, c.z})};
  }
  const Texture inside = textures.texture(*child->node);
  if (texture_kind(inside.word) == TextureKind::mesh_attribute) {
    p.error(parameter.name, fmt::format("'{}' is a mesh_attribute", parameter.name),
            "a value, or a texture that looks at texture coordinates");
  }
  return {slot(inside.mean, inside.word), slot(grey(inside.mean), inside.number != 0 ? inside.number : inside.word),
          inside.mean, inside.min, inside.max};
}

}  // namespace

Texture compile_texture_checkerboard(Parameters& p, Textures& textures) {
  const Square first = read_square(p, textures, kColor0), second = read_square(p, textures, kColor1);
  const isa_host::ToUvSlots to_uv = to_uv_slots(p.read(kToUv));
  Texture texture;
  texture.word =
      textures.add(isa_host::Checkerboard::Stored{.to_uv = to_uv, .color0 = first.color, .color1 = second.color});
  texture.number =
      textures.add(isa_host::Checkerboard::Stored{.to_uv = to_uv, .color0 = second.number, .color1 = first.number});
  texture.mean = (first.mean + second.mean) / 2.0;
  texture.min = std::min(first.min, second.min);
  texture.max = std::max(first.max, second.max);
  return texture;
}

}  // namespace norrsken
