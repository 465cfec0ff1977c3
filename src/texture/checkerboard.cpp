// checkerboard: host side.
//
// Where it stands for a number, such as a roughness, that is the mean of a colour, and the two change places: so do
// Mitsuba's images show it.
#include "texture/checkerboard.h"

#include <algorithm>
#include <glm/common.hpp>

#include "compile/textures.h"
#include "texture/texture_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kColor0{
    .name = "color0", .fallback = 0.4, .text = "where both coordinates are in the same half of their unit"};
constexpr ColorParameter kColor1{.name = "color1", .fallback = 0.2, .text = "elsewhere"};

}  // namespace

Texture compile_texture_checkerboard(Parameters& p, Textures& textures) {
  const glm::dvec3 color0 = p.read(kColor0).rgb(), color1 = p.read(kColor1).rgb();
  const isa_host::ToUvSlots to_uv = to_uv_slots(p.read(kToUv));
  const auto add = [&](const glm::vec3& first, const glm::vec3& second) {
    return textures.add(isa_host::Checkerboard::Stored{
        .to_uv = to_uv, .color0 = {{first.x, first.y, first.z}}, .color1 = {{second.x, second.y, second.z}}});
  };
  const glm::dvec3 low = glm::min(color0, color1), high = glm::max(color0, color1);
  Texture texture;
  texture.word = add(color0, color1);
  const auto mean = [](const glm::dvec3& c) { return glm::dvec3((c.x + c.y + c.z) / 3); };
  texture.number = add(mean(color1), mean(color0));
  texture.mean = (color0 + color1) / 2.0;
  texture.min = std::min({low.x, low.y, low.z});
  texture.max = std::max({high.x, high.y, high.z});
  return texture;
}

}  // namespace norrsken
