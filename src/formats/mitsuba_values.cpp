#include "formats/mitsuba_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/numbers.h"
#include "base/text.h"
#include "color/srgb.h"
#include "scene/constant_spectrum.h"
#include "scene/source_text.h"

namespace norrsken {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kSeparators = " \t\r\n,";

using Piece = TextPiece;

void complain(const Literal& literal, const Piece& piece, std::string_view what, std::string_view accepted,
              Diagnostics& diagnostics) {
  diagnostics.error(literal.location(piece.offset, piece.text.size()),
                    fmt::format("{} {}", literal.quote(piece.text), what), std::string(accepted));
}

Piece trimmed(const Literal& literal) {
  const std::string_view text = trim(literal.text);
  return {text, text.empty() ? 0 : literal.text.find(text)};
}

// The number that `piece` is, after a complaint nothing.
std::optional<double> number_of(const Literal& literal, const Piece& piece, Diagnostics& diagnostics) {
  double value = 0;
  const NumberStatus status = parse_number(piece.text, value);
  if (status == NumberStatus::ok) return value;
  complain(literal, piece, describe(status),
           status == NumberStatus::malformed ? "a number such as 1.5 or -2e3" : "a finite number", diagnostics);
  return std::nullopt;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// The components of #rrggbb, from 0 to 1.
std::optional<Property::Rgb> hex_color(std::string_view text) {
  if (text.size() != 7) return std::nullopt;
  Property::Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int high = hex_digit(text[1 + 2 * i]);
    const int low = hex_digit(text[2 + 2 * i]);
    if (high < 0 || low < 0) return std::nullopt;
    color.value[i] = (high * 16 + low) / 255.0;
  }
  return color;
}

Property::Rgb linear(const Property::Rgb& srgb) {
  return {{linear_from_srgb(srgb.value[0]), linear_from_srgb(srgb.value[1]), linear_from_srgb(srgb.value[2])}};
}

// Appends a sample; false if its wavelength is not one that may follow.
bool append(Property::Spectrum& spectrum, double wavelength, double value) {
  if (wavelength <= 0 || (!spectrum.samples.empty() && wavelength <= spectrum.samples.back().first)) return false;
  spectrum.samples.emplace_back(wavelength, value);
  return true;
}

constexpr const char* kWavelengthOrder = "is not above the wavelength before it";

}  // namespace

std::optional<bool> read_boolean(const Literal& literal, Diagnostics& diagnostics) {
  const Piece piece = trimmed(literal);
  if (equal_ignoring_case(piece.text, "true")) return true;
  if (equal_ignoring_case(piece.text, "false")) return false;
  complain(literal, piece, "is not a boolean", "true, false", diagnostics);
  return std::nullopt;
}

std::optional<std::int64_t> read_integer(const Literal& literal, Diagnostics& diagnostics) {
  const Piece piece = trimmed(literal);
  std::int64_t value = 0;
  const NumberStatus status = parse_integer(piece.text, value);
  if (status == NumberStatus::ok) return value;
  complain(literal, piece, status == NumberStatus::malformed ? "is not an integer" : describe(status),
           "an integer such as 16", diagnostics);
  return std::nullopt;
}

std::optional<double> read_float(const Literal& literal, Diagnostics& diagnostics) {
  return number_of(literal, trimmed(literal), diagnostics);
}

std::optional<std::vector<double>> read_floats(const Literal& literal, Diagnostics& diagnostics) {
  std::vector<double> values;
  bool good = true;
  for (const Piece& piece : split(literal.text, kSeparators)) {
    const auto value = number_of(literal, piece, diagnostics);
    good = good && value;
    if (value) values.push_back(*value);
  }
  return good ? std::optional(std::move(values)) : std::nullopt;
}

std::optional<glm::dvec3> read_vector(const Literal& literal, Diagnostics& diagnostics) {
  const auto values = read_floats(literal, diagnostics);
  if (!values) return std::nullopt;
  if (values->size() == 1) return glm::dvec3((*values)[0]);
  if (values->size() == 3) return glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
  complain(literal, trimmed(literal), fmt::format("has {} numbers", values->size()),
           "three numbers, or one for all three", diagnostics);
  return std::nullopt;
}

std::optional<Property::Rgb> read_rgb(const Literal& literal, HexColor hex, Diagnostics& diagnostics) {
  const Piece piece = trimmed(literal);
  if (piece.text.starts_with('#')) {
    if (const auto color = hex_color(piece.text)) return hex == HexColor::srgb ? linear(*color) : *color;
    complain(literal, piece, "is not a hexadecimal colour", "#rrggbb with digits 0 to 9 and a to f", diagnostics);
    return std::nullopt;
  }
  const auto value = read_vector(literal, diagnostics);
  return value ? std::optional(Property::Rgb{to_array(*value)}) : std::nullopt;
}

std::optional<Property::Rgb> read_srgb(const Literal& literal, Diagnostics& diagnostics) {
  const auto color = read_rgb(literal, HexColor::linear, diagnostics);
  return color ? std::optional(linear(*color)) : std::nullopt;
}

std::optional<Property::Spectrum> read_blackbody(const Element& element, Diagnostics& diagnostics) {
  Literal temperature = *element.find("temperature");
  if (Piece piece = trimmed(temperature); !piece.text.empty() && (piece.text.back() == 'K' || piece.text.back() == 'k'))
    temperature.text.resize(piece.offset + piece.text.size() - 1);
  double scale = 1;
  for (const char* name : {"scale", "multiplier"}) {
    const Literal* literal = element.find(name);
    const auto value = literal ? read_float(*literal, diagnostics) : std::optional(scale);
    if (!value) return std::nullopt;
    scale = *value;
  }
  const auto kelvin = read_float(temperature, diagnostics);
  if (!kelvin) return std::nullopt;
  if (!(*kelvin > 0 && *kelvin <= kMaxTemperature)) {
    complain(temperature, trimmed(temperature), "is not a temperature", "a number above 0, in kelvin", diagnostics);
    return std::nullopt;
  }
  return blackbody_spectrum(*kelvin, scale);
}

std::optional<Property::Spectrum> read_spectrum(const Literal& literal, Diagnostics& diagnostics) {
  constexpr const char* kAccepted = "a number, or wavelength:value pairs such as 400:0.1, 700:0.8";
  Property::Spectrum spectrum;
  if (literal.text.find(':') == std::string::npos) {
    const Piece piece = trimmed(literal);
    double value = 0;
    const NumberStatus status = parse_number(piece.text, value);
    if (status == NumberStatus::ok) {
      spectrum.samples = {{0, value}};
      return spectrum;
    }
    complain(literal, piece, describe(status), kAccepted, diagnostics);
    return std::nullopt;
  }
  for (const Piece& pair : split(literal.text, kSeparators)) {
    const std::size_t colon = pair.text.find(':');
    if (colon == std::string_view::npos) {
      complain(literal, pair, "is not a pair", kAccepted, diagnostics);
      return std::nullopt;
    }
    const Piece first{pair.text.substr(0, colon), pair.offset};
    const auto wavelength = number_of(literal, first, diagnostics);
    const auto value = number_of(literal, {pair.text.substr(colon + 1), pair.offset + colon + 1}, diagnostics);
    if (!wavelength || !value) return std::nullopt;
    if (!append(spectrum, *wavelength, *value)) {
      complain(literal, first, kWavelengthOrder, "wavelengths in nm, ascending", diagnostics);
      return std::nullopt;
    }
  }
  if (spectrum.samples.size() > 1) return spectrum;
  complain(literal, trimmed(literal), "is a spectrum at one wavelength", kAccepted, diagnostics);
  return std::nullopt;
}

std::optional<Property::Spectrum> read_spectrum_file(const SourceText& source, Diagnostics& diagnostics) {
  constexpr const char* kAccepted = "a wavelength in nm and a value on each line, # for comments";
  Property::Spectrum spectrum;
  const std::string_view text = source.text();
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string_view line = text.substr(start, end - start);
    line = line.substr(0, line.find('#'));
    const std::vector<Piece> pieces = split(line, kBlanks);
    double values[2] = {};
    for (std::size_t i = 0; i < std::min<std::size_t>(pieces.size(), 2); ++i) {
      const NumberStatus status = parse_number(pieces[i].text, values[i]);
      if (status == NumberStatus::ok) continue;
      diagnostics.error(source.location(start + pieces[i].offset, pieces[i].text.size()),
                        fmt::format("{} {}", quoted(pieces[i].text), describe(status)), kAccepted);
      return std::nullopt;
    }
    if (!pieces.empty() && pieces.size() != 2) {
      diagnostics.error(source.location(start, line.size()), fmt::format("{} numbers on a line", pieces.size()),
                        kAccepted);
      return std::nullopt;
    }
    if (!pieces.empty() && !append(spectrum, values[0], values[1])) {
      diagnostics.error(source.location(start + pieces[0].offset, pieces[0].text.size()),
                        fmt::format("{} {}", quoted(pieces[0].text), kWavelengthOrder), "wavelengths in nm, ascending");
      return std::nullopt;
    }
    start = end + 1;
  }
  if (spectrum.samples.size() > 1) return spectrum;
  diagnostics.error(source.location(),
                    spectrum.samples.empty() ? "the file has no spectrum" : "the file's spectrum is at one wavelength",
                    kAccepted);
  return std::nullopt;
}

std::optional<glm::dvec3> read_coordinates(const Element& element, std::optional<double> fallback,
                                           Diagnostics& diagnostics) {
  constexpr const char* kNames[] = {"x", "y", "z"};
  const Literal* value = element.find("value");
  glm::dvec3 result(fallback.value_or(0));
  bool good = true;
  for (int i = 0; i < 3; ++i) {
    const Literal* component = element.find(kNames[i]);
    if (component && value) {
      diagnostics.error(component->location(), fmt::format("'value' and '{}' say the same thing", kNames[i]),
                        "either value, or x, y and z");
      return std::nullopt;
    }
    if (component) {
      const auto number = read_float(*component, diagnostics);
      good = good && number;
      result[i] = number.value_or(0);
    } else if (!value && !fallback) {
      diagnostics.error(element.location, fmt::format("<{}> needs an attribute '{}'", element.name, kNames[i]),
                        "either value, or x, y and z");
      return std::nullopt;
    }
  }
  if (value) return read_vector(*value, diagnostics);
  return good ? std::optional(result) : std::nullopt;
}

}  // namespace norrsken
