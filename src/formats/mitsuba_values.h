// Values out of the text of attributes: numbers, colours, spectra, transformations.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/mitsuba_element.h"
#include "norrsken/diagnostics.h"
#include "scene/description.h"

namespace norrsken {

// All are empty after a complaint.
std::optional<bool> read_boolean(const Literal& literal, Diagnostics& diagnostics);
std::optional<std::int64_t> read_integer(const Literal& literal, Diagnostics& diagnostics);
std::optional<double> read_float(const Literal& literal, Diagnostics& diagnostics);
/// Numbers apart by blanks or commas.
std::optional<std::vector<double>> read_floats(const Literal& literal, Diagnostics& diagnostics);
/// Three numbers, or one for all three components.
std::optional<glm::dvec3> read_vector(const Literal& literal, Diagnostics& diagnostics);
/// What #rrggbb means in <rgb>: an 8-bit sRGB value as in HTML, or, as in Mitsuba 0.x, 255ths of linear values (in Mitsuba
/// 3 there is none).
enum class HexColor { srgb, linear };
/// Three numbers, one, or #rrggbb.
std::optional<Property::Rgb> read_rgb(const Literal& literal, HexColor hex, Diagnostics& diagnostics);
/// The same of sRGB values from 0 to 1: the <srgb> of Mitsuba 0.x.
std::optional<Property::Rgb> read_srgb(const Literal& literal, Diagnostics& diagnostics);
/// The <blackbody> of Mitsuba 0.x: a `temperature` in kelvin, such as "5000K", and a factor `scale` (or `multiplier`).
std::optional<Property::Spectrum> read_blackbody(const Element& element, Diagnostics& diagnostics);
/// One number, or "wavelength:value, ..." with wavelengths in nm, ascending.
std::optional<Property::Spectrum> read_spectrum(const Literal& literal, Diagnostics& diagnostics);
/// A .spd file: a wavelength in nm and a value a line, ascending, '#' begins a comment.
std::optional<Property::Spectrum> read_spectrum_file(const SourceText& source, Diagnostics& diagnostics);

/// `value`, or `x`, `y`, `z`, of which those not given are `fallback`; without a fallback all three are required.
std::optional<glm::dvec3> read_coordinates(const Element& element, std::optional<double> fallback,
                                           Diagnostics& diagnostics);

/// What a step of a <transform> may have: translate, scale, rotate, lookat (also look_at), matrix. Empty: no such step.
std::optional<AttributeRules> transform_step_rules(std::string_view name);
std::vector<std::string> transform_step_names();
/// The step <lookAt ox="" oy="" oz="" tx="" ty="" tz="" ux="" uy="" uz=""/> of Mitsuba before 0.3, which mirrored x besides.
/// No element can have such a name.
inline constexpr std::string_view kLookatOfNumbers = "lookAt ox";
/// What an axis of <rotate> means that is no unit vector: its direction alone, as in Mitsuba 0.x, or whatever the formula
/// for unit vectors makes of it, as in Mitsuba 3.
enum class RotationAxis { direction, as_given };
/// The matrix of one step.
std::optional<glm::dmat4> read_transform_step(const Element& step, RotationAxis axis, Diagnostics& diagnostics);

}  // namespace norrsken
