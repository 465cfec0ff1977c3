// Colours and spectra as pbrt's parameters give them, in linear sRGB.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "formats/pbrt/parameters.h"

namespace norrsken::pbrt {

class Context;

/// The space that rgb values are in.
struct ColorSpace {
  std::string_view name;
  glm::dmat3 srgb_from_reflectance;  ///< white to white
  glm::dmat3 srgb_from_light;
};
/// The one that files begin with.
const ColorSpace& srgb_space();
/// By its name in any case; null if there is none.
const ColorSpace* find_color_space(std::string_view name);
std::vector<std::string> color_space_names();

/// What a spectrum stands for, which decides what becomes of it.
enum class Slot {
  albedo,      ///< a share of light, 0 to 1
  unbounded,   ///< such as an index of refraction
  illuminant,  ///< light: what is no rgb is scaled to the luminance 1, as pbrt's lights do
};

/// The `rgb`, `spectrum` or `blackbody` of that name. Empty if it is not given, or after a complaint.
std::optional<glm::dvec3> read_color(Context& context, Parameters& p, std::string_view name, Slot slot,
                                     const ColorSpace& space);
/// The same of a parameter that has been found.
std::optional<glm::dvec3> color_of(Context& context, Parameters& p, const Parameter& parameter, Slot slot,
                                   const ColorSpace& space);

/// The metal of a spectrum by name, "Cu" of "metal-Cu-eta", with `part` behind it; empty if it is no such name.
std::string_view metal_of(const Parameter& parameter, std::string_view part);

/// An index of refraction: a `float`, or a spectrum, of which one value has to do. A note tells so.
double read_index(Context& context, Parameters& p, std::string_view name, double fallback);

}  // namespace norrsken::pbrt
