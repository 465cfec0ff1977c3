#include "formats/pbrt/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "base/numbers.h"
#include "base/text.h"
#include "color/spectrum.h"
#include "formats/pbrt/context.h"
#include "formats/pbrt/named_spectra.h"

namespace norrsken::pbrt {
namespace {

using Samples = std::vector<std::pair<double, double>>;
constexpr double kFirstWavelength = 360, kLastWavelength = 830;  // nm, of pbrt

glm::dvec3 to_vector(const ColorVector& v) { return {v[0], v[1], v[2]}; }
double luminance_of(const glm::dvec3& c) { return luminance(c.r, c.g, c.b); }

glm::dmat3 to_matrix(const ColorMatrix& m) {
  glm::dmat3 matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      matrix[column][row] = m[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }
  return matrix;
}

ColorSpace make_space(std::string_view name, Chromaticity red, Chromaticity green, Chromaticity blue,
                      Chromaticity white) {
  const glm::dmat3 light = to_matrix(kSrgbFromXyz) * to_matrix(xyz_from_rgb(red, green, blue, white));
  // White paper is white under any light: each of our channels is scaled so that it is (von Kries, in sRGB).
  const glm::dvec3 of_white = light * glm::dvec3(1);
  glm::dmat3 reflectance = light;
  for (int column = 0; column < 3; ++column) reflectance[column] /= of_white;
  return {name, reflectance, light};
}

// Primaries and whites: IEC 61966-2-1, SMPTE EG 432-1 with D65, ITU-R BT.2020, SMPTE ST 2065-1.
const ColorSpace (&color_spaces())[4] {
  static const ColorSpace kSpaces[] = {
      {"srgb", glm::dmat3(1), glm::dmat3(1)},
      make_space("dci-p3", {0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}, kSrgbWhite),
      make_space("rec2020", {0.708, 0.292}, {0.17, 0.797}, {0.131, 0.046}, kSrgbWhite),
      make_space("aces2065-1", {0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}),
  };
  return kSpaces;
}

Samples blackbody(double temperature) {
  Samples samples;
  double most = 0;
  for (double wavelength = kFirstWavelength; wavelength <= kLastWavelength; wavelength += 5) {
    samples.emplace_back(wavelength, blackbody_radiance(wavelength, temperature));
    most = std::max(most, samples.back().second);
  }
  for (auto& sample : samples) sample.second = most > 0 ? sample.second / most : 0;
  return samples;
}

/// Pairs of wavelengths and values, checked. Empty after a complaint.
Samples to_samples(Parameters& p, const Parameter& parameter, const Array<double>& numbers) {
  Samples samples;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    if (!(numbers[i] > (samples.empty() ? 0 : samples.back().first))) {
      p.error(&parameter,
              fmt::format("wavelength {:g} of '{}' is not above the one before", numbers[i], parameter.name),
              "pairs of a wavelength in nm and a value, wavelengths ascending");
      return {};
    }
    samples.emplace_back(numbers[i], numbers[i + 1]);
  }
  // Two samples make a curve; pbrt's is 0 outside of it, and so at all wavelengths but one.
  if (samples.size() < 2) {
    p.error(
        &parameter,
        fmt::format("spectrum '{}' has {} wavelength{}", parameter.name, samples.size(), samples.empty() ? "s" : ""),
        "two or more");
    return {};
  }
  return samples;
}

Samples read_samples(Context& context, Parameters& p, const Parameter& parameter) {
  const std::string path = context.find_file(parameter);
  if (path.empty()) return {};
  std::string error;
  const auto contents = read_counted(context.files, path, error);
  if (!contents) {
    p.error(&parameter, fmt::format("cannot read the spectrum {}: {}", quoted(path, 200), error), "a text file");
    return {};
  }
  Array<double> numbers;
  for (const TextPiece& line : split(contents->bytes, "\r\n")) {
    for (const TextPiece& word : split(line.text.substr(0, line.text.find('#')), " \t")) {
      double value = 0;
      if (parse_number(word.text, value) != NumberStatus::ok) {
        p.error(&parameter, fmt::format("{} in the spectrum {} is not a number", quoted(word.text), quoted(path, 200)),
                "pairs of a wavelength in nm and a value");
        return {};
      }
      numbers.push_back(value);
    }
  }
  return to_samples(p, parameter, numbers);
}

/// The colour of a spectrum: with `slot` a light's, scaled to luminance 1, or that of a surface in daylight.
glm::dvec3 color_of_samples(const Samples& samples, Slot slot) {
  if (slot != Slot::illuminant) return to_vector(rgb_of_reflectance(samples));
  const glm::dvec3 rgb = to_vector(rgb_of_emission(samples));
  const double y = luminance_of(rgb);
  return y > 0 ? rgb / y : glm::dvec3(0);
}

std::optional<glm::dvec3> color_of_name(Context& context, Parameters& p, const Parameter& parameter, Slot slot) {
  const std::string& name = parameter.strings[0];
  if (const auto metal = named_metal(name)) return metal;
  if (const auto glass = named_glass(name)) return glm::dvec3(*glass);
  if (const auto light = named_illuminant(name)) {
    if (slot != Slot::illuminant)
      context.tell(parameter.place, "a standard illuminant in place of a surface's spectrum is taken by its colour",
                   "a spectrum of pairs");
    return light;
  }
  const Samples samples = read_samples(context, p, parameter);
  if (samples.empty()) return std::nullopt;
  return color_of_samples(samples, slot);
}

}  // namespace

const ColorSpace& srgb_space() { return color_spaces()[0]; }

const ColorSpace* find_color_space(std::string_view name) {
  for (const ColorSpace& space : color_spaces()) {
    if (equal_ignoring_case(space.name, name)) return &space;
  }
  return nullptr;
}

std::vector<std::string> color_space_names() {
  std::vector<std::string> names;
  for (const ColorSpace& space : color_spaces()) names.emplace_back(space.name);
  return names;
}

std::optional<glm::dvec3> color_of(Context& context, Parameters& p, const Parameter& parameter, Slot slot,
                                   const ColorSpace& space) {
  std::optional<glm::dvec3> color;
  if (parameter.type == "rgb") {
    if (!p.has_values(parameter, 3)) return std::nullopt;
    const glm::dvec3 rgb(parameter.numbers[0], parameter.numbers[1], parameter.numbers[2]);
    if (glm::any(glm::lessThan(rgb, glm::dvec3(0))) ||
        (slot == Slot::albedo && glm::any(glm::greaterThan(rgb, glm::dvec3(1))))) {
      p.error(&parameter, fmt::format("'{}' of {} is {:g} {:g} {:g}", parameter.name, p.object(), rgb.r, rgb.g, rgb.b),
              slot == Slot::albedo ? "components from 0 to 1" : "components from 0");
      return std::nullopt;
    }
    color = (slot == Slot::illuminant ? space.srgb_from_light : space.srgb_from_reflectance) * rgb;
  } else if (parameter.type == "blackbody") {
    if (!p.has_values(parameter, 1)) return std::nullopt;
    const double temperature = parameter.numbers[0];
    if (!(temperature > 0 && temperature < 1e12)) {
      p.error(&parameter, fmt::format("'{}' of {} is {:g} K", parameter.name, p.object(), temperature),
              "a temperature above 0 K");
      return std::nullopt;
    }
    color = color_of_samples(blackbody(temperature), slot);
  } else if (!parameter.strings.empty()) {
    color = color_of_name(context, p, parameter, slot);
  } else {
    const Samples samples = to_samples(p, parameter, parameter.numbers);
    if (!samples.empty()) color = color_of_samples(samples, slot);
  }
  if (!color) return std::nullopt;
  const glm::dvec3 inside =
      glm::clamp(*color, glm::dvec3(0), glm::dvec3(slot == Slot::albedo ? 1 : Parameters::kInfinity));
  if (glm::any(glm::greaterThan(glm::abs(inside - *color), glm::dvec3(0.02))))
    p.note(&parameter, "colours beyond sRGB are brought into it, component by component");
  return inside;
}

std::optional<glm::dvec3> read_color(Context& context, Parameters& p, std::string_view name, Slot slot,
                                     const ColorSpace& space) {
  const Parameter* parameter = p.find({"rgb", "spectrum", "blackbody"}, name);
  return parameter ? color_of(context, p, *parameter, slot, space) : std::nullopt;
}

std::string_view metal_of(const Parameter& parameter, std::string_view part) {
  if (parameter.strings.empty() || !named_metal(parameter.strings[0])) return {};
  const std::string_view name = parameter.strings[0];
  constexpr std::size_t kBegin = std::string_view("metal-").size();
  const std::size_t end = name.rfind('-');
  return name.substr(end + 1) == part ? name.substr(kBegin, end - kBegin) : std::string_view();
}

double read_index(Context& context, Parameters& p, std::string_view name, double fallback) {
  const Parameter* parameter = p.find({"float", "spectrum"}, name);
  if (!parameter) return fallback;
  double index = fallback;
  if (parameter->type == "float") {
    if (!p.has_values(*parameter, 1)) return fallback;
    index = parameter->numbers[0];
  } else if (const auto color = color_of(context, p, *parameter, Slot::unbounded, srgb_space())) {
    const auto glass = parameter->strings.empty() ? std::nullopt : named_glass(parameter->strings[0]);
    index = glass ? *glass : luminance_of(*color);
    context.tell(parameter->place,
                 "an index of refraction that depends on the wavelength: one value is taken, without dispersion");
  }
  if (index > 0) return index;
  p.error(parameter, fmt::format("'{}' of {} is {:g}", name, p.object(), index), "a number above 0");
  return fallback;
}

}  // namespace norrsken::pbrt
