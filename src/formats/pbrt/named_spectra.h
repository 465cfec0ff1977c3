// The spectra that pbrt has names for, as colours.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

namespace norrsken::pbrt {

/// A standard illuminant, "stdillum-D50": linear sRGB of luminance 1.
std::optional<glm::dvec3> named_illuminant(std::string_view name);
/// A metal's constants, "metal-Cu-eta".
std::optional<glm::dvec3> named_metal(std::string_view name);
/// A glass, "glass-BK7": its index of refraction at 587.6 nm.
std::optional<double> named_glass(std::string_view name);

}  // namespace norrsken::pbrt
