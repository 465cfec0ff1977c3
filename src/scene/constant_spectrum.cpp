// Model       blackbody, d65, irregular, rawconstant, regular, rgb, srgb, uniform
// Parameters
//   blackbody    temperature (K, above 0): Planck's radiance in W/(m^2 sr nm)
//   d65          color (rgb, default 1), scale (default 1): in RGB daylight is white; or a nested spectrum or texture, which
//                it then is, without a scale
//   irregular    value (spectrum); or wavelengths (nm) and values, strings of numbers
//   rawconstant  value (float or vector): never converted
//   regular      value (spectrum); or wavelength_min, wavelength_max (nm) and values, a string of numbers
//   rgb          value (rgb)
//   srgb         color (rgb)
//   uniform      value; wavelength_min and wavelength_max mean nothing in RGB
// Source      Mitsuba 3's documentation of its spectra, and what its RGB variants make of them
// Departures  Mitsuba's RGB variants refuse to render blackbody, regular and irregular; here they are converted as other
//             spectra are
#include "scene/constant_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/text.h"
#include "color/cie_tables.h"
#include "color/spectrum.h"
#include "scene/parameters.h"

namespace norrsken {
namespace {

constexpr double kMaxWavelength = 1e6;  // nm

using Value = Property::Value;

constexpr NumberParameter kTemperature{.name = "temperature",
                                       .fallback = 5000,
                                       .range = above(0, kMaxTemperature),
                                       .example = R"(<float name="temperature" value="5000"/>)"};
constexpr NumberParameter kScale{.name = "scale", .fallback = 1};
constexpr ColorParameter kColor{.name = "color", .fallback = 1};
constexpr ColorParameter kOwnValue{.name = "value", .example = R"(<rgb name="value" value="0.5 0.5 0.5"/>)"};
constexpr ColorParameter kOwnColor{.name = "color", .example = R"(<rgb name="color" value="0.5 0.5 0.5"/>)"};
constexpr BooleanParameter kUnbounded{.name = "unbounded"};
constexpr NumberParameter kValue{.name = "value", .example = R"(<float name="value" value="0.5"/>)"};
constexpr ColorParameter kRawValue{.name = "value", .example = R"(<float name="value" value="0.5"/>)"};
constexpr PointParameter kRawVector{.name = "value"};
constexpr NumberParameter kFirst{
    .name = "wavelength_min", .fallback = kCieFirstWavelength, .range = {0, kMaxWavelength}};
constexpr NumberParameter kLast{.name = "wavelength_max", .fallback = kCieLastWavelength, .range = {0, kMaxWavelength}};
constexpr NumberParameter kFirstOfRegular{.name = "wavelength_min",
                                          .fallback = 400,
                                          .range = above(0, kMaxWavelength),
                                          .example = R"(<float name="wavelength_min" value="400"/>)"};
constexpr NumberParameter kLastOfRegular{
    .name = "wavelength_max", .fallback = 700, .example = R"(<float name="wavelength_max" value="700"/>)"};
constexpr SpectrumParameter kSpectrum{.name = "value"};
constexpr NumbersParameter kWavelengths{.name = "wavelengths",
                                        .example = R"(<string name="wavelengths" value="..."/>)"};
constexpr NumbersParameter kValues{.name = "values", .example = R"(<string name="values" value="..."/>)"};

Value blackbody(Parameters& p) { return blackbody_spectrum(p.read(kTemperature)); }

Value rgb(Parameters& p) { return Property::Rgb{to_array(p.read(kOwnValue).rgb())}; }

/// The spectrum or texture that a d65 node has inside, under whatever name.
const Node* inside_of_daylight(const Node& node) {
  for (const Node::Child& child : node.children) {
    if (is_spectrum_or_texture(*child.node) && child.name != kColor.name) return child.node.get();
  }
  return nullptr;
}

Value d65(Parameters& p) {
  if (const Node* inside = inside_of_daylight(p.node())) {
    read_daylight(p);
    return p.constant(*inside);
  }
  const double scale = p.read(kScale);
  return Property::Rgb{to_array(scale * p.read(kColor).rgb())};
}

Value srgb(Parameters& p) {
  p.read(kUnbounded);  // whoever asks for the colour says what is in range
  return Property::Rgb{to_array(p.read(kOwnColor).rgb())};
}

Value uniform(Parameters& p) {
  p.read(kFirst);
  p.read(kLast);
  return p.read(kValue);
}

Value rawconstant(Parameters& p) {
  const auto is_vector = [](const Property& property) {
    return property.name == kRawVector.name && std::holds_alternative<Property::Vector>(property.value);
  };
  if (std::ranges::any_of(p.node().properties, is_vector)) return Property::Rgb{to_array(p.read(kRawVector))};
  return Property::Rgb{to_array(p.read(kRawValue).rgb())};
}

/// At least two values; a complaint otherwise.
std::vector<double> two_or_more(Parameters& p, const NumbersParameter& numbers) {
  std::vector<double> values = p.read(numbers);
  if (values.size() != 1) return values;
  p.error(numbers.name, fmt::format("'{}' is one number", numbers.name), "two numbers or more");
  return {};
}

Value regular(Parameters& p) {
  if (p.has(kSpectrum.name)) return Property::Spectrum{p.read(kSpectrum)};
  const double first = p.read(kFirstOfRegular);
  const double last = p.read(kLastOfRegular.or_else(std::max(first + 1, 700.0)).within(above(first)));
  const std::vector<double> values = two_or_more(p, kValues);
  Property::Spectrum spectrum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(values.size() - 1);
    spectrum.samples.emplace_back(first + t * (last - first), values[i]);
  }
  return spectrum;
}

Value irregular(Parameters& p) {
  if (p.has(kSpectrum.name)) return Property::Spectrum{p.read(kSpectrum)};
  const std::vector<double> wavelengths = two_or_more(p, kWavelengths), values = two_or_more(p, kValues);
  if (wavelengths.empty() || values.empty()) return Property::Spectrum{};
  if (wavelengths.size() != values.size()) {
    p.error(kValues.name, fmt::format("{} wavelengths and {} values", wavelengths.size(), values.size()),
            "as many values as wavelengths");
    return Property::Spectrum{};
  }
  Property::Spectrum spectrum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(wavelengths[i] > (i == 0 ? 0 : wavelengths[i - 1]))) {
      p.error(kWavelengths.name, fmt::format("{} is not above the wavelength before it", wavelengths[i]),
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

constexpr std::array<Plugin, 8> kPlugins{{{"blackbody", blackbody},
                                          {"d65", d65},
                                          {"irregular", irregular},
                                          {"rawconstant", rawconstant},
                                          {"regular", regular},
                                          {"rgb", rgb},
                                          {"srgb", srgb},
                                          {"uniform", uniform}}};

const Plugin* find(const Node& node) {
  const auto found = std::ranges::find(kPlugins, std::string_view(node.plugin), &Plugin::name);
  return found == kPlugins.end() ? nullptr : found;
}

}  // namespace

bool is_spectrum_or_texture(const Node& node) { return node.kind == "spectrum" || node.kind == "texture"; }

bool is_constant_spectrum(const Node& node) {
  return is_spectrum_or_texture(node) && find(node) != nullptr && texture_in_daylight(node) == nullptr;
}

const Node* texture_in_daylight(const Node& node) {
  if (!is_spectrum_or_texture(node) || node.plugin != "d65") return nullptr;
  const Node* inside = inside_of_daylight(node);
  return inside != nullptr && !is_constant_spectrum(*inside) ? inside : nullptr;
}

void read_daylight(Parameters& node) {
  for (const char* kind : {"spectrum", "texture"}) node.children(kind);
  node.read(kScale);
  if (!node.has(kScale.name)) return;
  node.diagnostics().note(
      node.where(kScale.name),
      "'scale' of a d65 with a spectrum or texture inside has no effect, as in Mitsuba's RGB variants",
      "a scale of the emitter, or of the values inside");
}

Property::Spectrum blackbody_spectrum(double temperature, double scale) {
  Property::Spectrum spectrum;
  for (std::size_t i = 0; i < kCieTable.size(); ++i) {
    const double wavelength = kCieFirstWavelength + kCieStep * static_cast<double>(i);
    spectrum.samples.emplace_back(wavelength, scale * blackbody_radiance(wavelength, temperature));
  }
  return spectrum;
}

Property::Value read_constant_spectrum(Parameters& node) { return find(node.node())->read(node); }

}  // namespace norrsken
