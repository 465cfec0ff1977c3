// Model       blackbody, d65, irregular, rawconstant, regular, srgb, uniform
// Parameters
//   blackbody    temperature (K, above 0): Planck's radiance in W/(m^2 sr nm)
//   d65          color (rgb, default 1), scale (default 1): in RGB daylight is white
//   irregular    value (spectrum); or wavelengths (nm) and values, strings of numbers
//   rawconstant  value (float or vector): never converted
//   regular      value (spectrum); or wavelength_min, wavelength_max (nm) and values, a string of numbers
//   srgb         color (rgb)
//   uniform      value; wavelength_min and wavelength_max mean nothing in RGB
// Source      Mitsuba 3's documentation of its spectra, and what its RGB variants make of them
// Departures  Mitsuba's RGB variants refuse to render blackbody, regular and irregular; here they are converted as other
//             spectra are
#include "scene/constant_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "base/text.h"
#include "color/cie_tables.h"
#include "color/spectrum.h"
#include "scene/parameters.h"

namespace norrsken {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kMaxWavelength = 1e6;  // nm

using Value = Property::Value;

Value blackbody(Parameters& p) {
  p.require("temperature", "<float name=\"temperature\" value=\"5000\"/>");
  const double temperature = p.number("temperature", 5000, 0, kMaxTemperature, Ends::open_below);
  return blackbody_spectrum(temperature);
}

Value d65(Parameters& p) {
  const double scale = p.number("scale", 1, -kAny, kAny);
  return Property::Rgb{to_array(scale * p.color("color", glm::dvec3(1), -kAny, kAny))};
}

Value srgb(Parameters& p) {
  p.require("color", "<rgb name=\"color\" value=\"0.5 0.5 0.5\"/>");
  p.boolean("unbounded", false);  // whoever asks for the colour says what is in range
  return Property::Rgb{to_array(p.color("color", glm::dvec3(0), -kAny, kAny))};
}

Value uniform(Parameters& p) {
  p.require("value", "<float name=\"value\" value=\"0.5\"/>");
  p.number("wavelength_min", kCieFirstWavelength, 0, kMaxWavelength);
  p.number("wavelength_max", kCieLastWavelength, 0, kMaxWavelength);
  return p.number("value", 0, -kAny, kAny);
}

Value rawconstant(Parameters& p) {
  p.require("value", "<float name=\"value\" value=\"0.5\"/>");
  const auto is_vector = [](const Property& property) {
    return property.name == "value" && std::holds_alternative<Property::Vector>(property.value);
  };
  if (std::ranges::any_of(p.node().properties, is_vector))
    return Property::Rgb{to_array(p.point("value", glm::dvec3(0)))};
  return Property::Rgb{to_array(p.color("value", glm::dvec3(0), -kAny, kAny))};
}

/// At least two values; a complaint otherwise.
std::vector<double> values_of(Parameters& p, std::string_view name) {
  if (!p.require(name, fmt::format("<string name=\"{}\" value=\"...\"/>", name))) return {};
  std::vector<double> values = p.numbers(name);
  if (values.size() != 1) return values;
  p.error(name, fmt::format("'{}' is one number", name), "two numbers or more");
  return {};
}

Value regular(Parameters& p) {
  if (p.has("value")) return Property::Spectrum{p.spectrum("value")};
  p.require("wavelength_min", "<float name=\"wavelength_min\" value=\"400\"/>");
  p.require("wavelength_max", "<float name=\"wavelength_max\" value=\"700\"/>");
  const double first = p.number("wavelength_min", 400, 0, kMaxWavelength, Ends::open_below);
  const double last = p.number("wavelength_max", std::max(first + 1, 700.0), first, kAny, Ends::open_below);
  const std::vector<double> values = values_of(p, "values");
  Property::Spectrum spectrum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(values.size() - 1);
    spectrum.samples.emplace_back(first + t * (last - first), values[i]);
  }
  return spectrum;
}

Value irregular(Parameters& p) {
  if (p.has("value")) return Property::Spectrum{p.spectrum("value")};
  const std::vector<double> wavelengths = values_of(p, "wavelengths"), values = values_of(p, "values");
  if (wavelengths.empty() || values.empty()) return Property::Spectrum{};
  if (wavelengths.size() != values.size()) {
    p.error("values", fmt::format("{} wavelengths and {} values", wavelengths.size(), values.size()),
            "as many values as wavelengths");
    return Property::Spectrum{};
  }
  Property::Spectrum spectrum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(wavelengths[i] > (i == 0 ? 0 : wavelengths[i - 1]))) {
      p.error("wavelengths", fmt::format("{} is not above the wavelength before it", wavelengths[i]),
              "wavelengths in nm, ascending");
      return Property::Spectrum{};
    }
    spectrum.samples.emplace_back(wavelengths[i], values[i]);
  }
  return spectrum;
}

struct Plugin {
  std::string_view name;
  Value (*read)(Parameters&);
};

constexpr std::array<Plugin, 7> kPlugins{{{"blackbody", blackbody},
                                          {"d65", d65},
                                          {"irregular", irregular},
                                          {"rawconstant", rawconstant},
                                          {"regular", regular},
                                          {"srgb", srgb},
                                          {"uniform", uniform}}};

const Plugin* find(const Node& node) {
  const auto found = std::ranges::find(kPlugins, std::string_view(node.plugin), &Plugin::name);
  return found == kPlugins.end() ? nullptr : found;
}

}  // namespace

bool is_spectrum_or_texture(const Node& node) { return node.kind == "spectrum" || node.kind == "texture"; }

bool is_constant_spectrum(const Node& node) { return is_spectrum_or_texture(node) && find(node) != nullptr; }

Property::Spectrum blackbody_spectrum(double temperature, double scale) {
  Property::Spectrum spectrum;
  for (std::size_t i = 0; i < kCieTable.size(); ++i) {
    const double wavelength = kCieFirstWavelength + kCieStep * static_cast<double>(i);
    spectrum.samples.emplace_back(wavelength, scale * blackbody_radiance(wavelength, temperature));
  }
  return spectrum;
}

Property read_constant_spectrum(Parameters& node) {
  Property property;
  property.type = node.node().kind;
  property.value = find(node.node())->read(node);
  return property;
}

}  // namespace norrsken
