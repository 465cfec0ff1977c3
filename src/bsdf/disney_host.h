// The parameters that both of Disney's materials have.
#pragma once

#include "scene/parameter.h"

namespace norrsken::disney {

inline constexpr double kMaxIndex = 1e4;

/// What is out of range is clamped.
constexpr NumberParameter share(std::string_view name, double fallback, std::string_view text) {
  return {.name = name, .fallback = fallback, .range = kShare, .text = text, .beyond = Beyond::is_clamped};
}
constexpr NumberParameter rate(std::string_view name, std::string_view lobe) {
  return {.name = name, .fallback = 1, .range = {0, 1e6}, .text = lobe};
}

inline constexpr ColorParameter kBaseColor{.name = "base_color", .fallback = 0.5, .range = kShare};
inline constexpr NumberParameter kRoughness = share("roughness", 0.5, "root of the facets' slope");
inline constexpr NumberParameter kAnisotropic =
    share("anisotropic", 0, "roughness less along u of the texture coordinates than along v");
inline constexpr NumberParameter kSheen = share("sheen", 0, "a lobe at grazing angles");
inline constexpr NumberParameter kSheenTint = share("sheen_tint", 0, "how far sheen has base_color's tint");
inline constexpr NumberParameter kFlatness =
    share("flatness", 0, "from diffuse to an approximation of subsurface scattering");

}  // namespace norrsken::disney
