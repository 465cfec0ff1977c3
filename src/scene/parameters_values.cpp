// The parameters that have one value: switches, numbers, words, colours, places.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "base/text.h"
#include "scene/constant_spectrum.h"
#include "scene/find_file.h"
#include "scene/parameters.h"
#include "scene/parameters_find.h"

namespace norrsken {
namespace {

// What a float can hold with room for a few products. Wider bounds are narrowed to it and not mentioned.
constexpr double kMaxNumber = 1e30;
// |det| below this share of the product of the column lengths is singular but for rounding.
constexpr double kSingular = 1e-12;

std::string range_text(std::string_view noun, std::string_view lower, std::string_view upper, bool has_min,
                       bool has_max, Ends ends) {
  if (has_min && has_max && ends == Ends::closed) return fmt::format("{} from {} to {}", noun, lower, upper);
  const std::string_view below = ends == Ends::open ? "below" : "at most";
  std::string text(noun);
  if (has_min) text += fmt::format(" {} {}", ends == Ends::closed ? "of at least" : "above", lower);
  if (has_max && has_min) text += fmt::format(" and {} {}", below, upper);
  if (has_max && !has_min) text += fmt::format(" {}{} {}", ends == Ends::open ? "" : "of ", below, upper);
  return text;
}

// Bounds that only say what the program can calculate with are worth a mention only to someone who went beyond them.
std::string number_range(std::string_view noun, const Range& range, double value) {
  return range_text(noun, fmt::format("{:g}", range.min), fmt::format("{:g}", range.max),
                    range.min > -kMaxCoordinate || value < range.min, range.max < kMaxCoordinate || value > range.max,
                    range.ends);
}

Range narrowed(const Range& range) {
  return {std::max(range.min, -kMaxNumber), std::min(range.max, kMaxNumber), range.ends};
}

bool contains(const Range& range, double value) {
  return (range.ends == Ends::closed ? value >= range.min : value > range.min) &&
         (range.ends == Ends::open ? value < range.max : value <= range.max);
}

bool is_finite(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!(std::abs(m[column][row]) <= kMaxCoordinate)) return false;
    }
  }
  return true;
}

// What is wrong with a placement, and what would be right; nothing if it is fine.
std::pair<std::string_view, std::string> complaint_about(const glm::dmat4& m, Flat flat) {
  if (!is_finite(m)) return {"has elements that are too large", fmt::format("elements up to {:g}", kMaxCoordinate)};
  const bool affine = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
  if (!affine) return {"is not affine", "a matrix whose last row is 0 0 0 1"};
  if (flat == Flat::yes) return {};
  const glm::dmat3 linear(m);
  const double volume = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  if (!(std::abs(glm::determinant(linear)) > kSingular * volume))
    return {"cannot be inverted", "scale factors other than 0"};
  return {};
}

}  // namespace

template <typename... Types>
const Property* Parameters::find_value(std::string_view name, std::string_view accepted, Property& storage) {
  const Node::Child* child = find_child(name);
  if (!child || !is_constant_spectrum(*child->node)) return find_as<Types...>(name, accepted);
  asked_names_.emplace(name);
  const auto errors = diagnostics_.error_count();
  storage.type = child->node->kind;
  storage.value = constant(*child->node);
  return diagnostics_.error_count() == errors ? &storage : nullptr;
}

Property::Value Parameters::constant(const Node& node) {
  Parameters inside(node, description_, files_, diagnostics_);
  Property::Value value = read_constant_spectrum(inside);
  inside.finish();
  return value;
}

bool Parameters::read(const BooleanParameter& boolean) {
  ask(boolean, PluginParameter::Type::boolean, boolean.fallback ? "true" : "false");
  const Property* property = find_as<bool>(boolean.name, "boolean");
  return property ? std::get<bool>(property->value) : boolean.fallback;
}

std::int64_t Parameters::read(const IntegerParameter& integer) {
  ask(integer, PluginParameter::Type::integer, std::to_string(integer.fallback));
  note_range(integer.name, {static_cast<double>(integer.min), static_cast<double>(integer.max)});
  const Property* property = find_as<std::int64_t>(integer.name, "integer");
  if (!property) return integer.fallback;
  const std::int64_t value = std::get<std::int64_t>(property->value);
  if (value >= integer.min && value <= integer.max) return value;
  using Limits = std::numeric_limits<std::int64_t>;
  error(integer.name, fmt::format("'{}' is {}{}", integer.name, value, property->origin),
        range_text("an integer", std::to_string(integer.min), std::to_string(integer.max), integer.min != Limits::min(),
                   integer.max != Limits::max(), Ends::closed));
  return integer.fallback;
}

std::optional<double> Parameters::value_of(const Property& property, std::string_view name) {
  if (const double* real = std::get_if<double>(&property.value)) return *real;
  if (const std::int64_t* integer = std::get_if<std::int64_t>(&property.value)) return static_cast<double>(*integer);
  const std::optional<SceneColor> color = color_of(property, name, narrowed({}), ColorOf::surface);
  if (!color) return std::nullopt;
  return color->mean();
}

double Parameters::read(const NumberParameter& number) {
  ask(number, PluginParameter::Type::number, fmt::format("{}", number.fallback));
  note_range(number.name, number.range);
  if (record_) recorded(number.name).is_clamped = number.beyond != Beyond::is_an_error;
  Property storage;
  const Property* property = number.takes_colors ? find_value<double, std::int64_t, Property::Rgb, Property::Spectrum>(
                                                       number.name, "float, rgb, spectrum", storage)
                                                 : find_value<double, std::int64_t>(number.name, "float", storage);
  if (!property) return number.fallback;
  const std::optional<double> known = value_of(*property, number.name);
  if (!known) return number.fallback;
  const double value = *known;
  const Range range = number.beyond == Beyond::is_an_error ? narrowed(number.range) : number.range;
  if (contains(range, value)) return value;
  if (number.beyond == Beyond::is_an_error) {
    const bool is_mean =
        !std::holds_alternative<double>(property->value) && !std::holds_alternative<std::int64_t>(property->value);
    error(number.name,
          fmt::format("'{}' is {}{}{}", number.name, value, is_mean ? " in the mean" : "", property->origin),
          number_range("a number", range, value));
    return number.fallback;
  }
  const double clamped = std::clamp(value, range.min, range.max);
  const std::string message =
      fmt::format("'{}' is {:g}{}, which is taken for {:g}", number.name, value, property->origin, clamped);
  const std::string accepted = number_range("a number", range, value);
  number.beyond == Beyond::is_clamped_with_a_note ? diagnostics_.note(where(number.name), message, accepted)
                                                  : diagnostics_.warning(where(number.name), message, accepted);
  return clamped;
}

std::string Parameters::read(const TextParameter& text) {
  ask(text, PluginParameter::Type::text, std::string(text.fallback));
  const Property* property = find_as<std::string>(text.name, "string");
  return property ? std::get<std::string>(property->value) : std::string(text.fallback);
}

std::size_t Parameters::read_choice(std::string_view name, const std::vector<std::string>& words, std::size_t fallback,
                                    std::string_view text) {
  ask(TextParameter{.name = name, .text = text}, PluginParameter::Type::text, words[fallback]);
  if (record_) recorded(name).choices = words;
  const Property* property = find_as<std::string>(name, "string: " + join(words));
  if (!property) return fallback;
  const std::string& value = std::get<std::string>(property->value);
  const auto same = [&](const std::string& word) { return equal_ignoring_case(word, value); };
  const auto found = std::ranges::find_if(words, same);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  error(name, fmt::format("'{}' is {}{}{}", name, quoted(value), property->origin, did_you_mean(value, words)),
        join(words));
  return fallback;
}

SceneColor Parameters::read(const ColorParameter& color) {
  ask(color, PluginParameter::Type::color, fmt::format("{}", color.fallback));
  note_range(color.name, color.range);
  Property storage;
  const Property* property =
      find_value<Property::Rgb, Property::Spectrum, double, std::int64_t>(color.name, "rgb, spectrum, float", storage);
  std::optional<SceneColor> value;
  if (property) value = color_of(*property, color.name, narrowed(color.range), color.of);
  return value ? *std::move(value) : SceneColor(color.fallback);
}

std::optional<SceneColor> Parameters::color_of(const Property& property, std::string_view name, const Range& range,
                                               ColorOf of) {
  if (const auto* spectrum = std::get_if<Property::Spectrum>(&property.value)) {
    for (const auto& [wavelength, value] : spectrum->samples) {
      if (contains(range, value)) continue;
      error(name, fmt::format("'{}' has a value of {}{}", name, value, property.origin),
            number_range("a spectrum with values", range, value));
      return std::nullopt;
    }
    return SceneColor(spectrum->samples, of, range);
  }
  SceneColor color;
  if (const auto* rgb = std::get_if<Property::Rgb>(&property.value)) {
    color = SceneColor(to_glm(rgb->value));
  } else if (const auto* real = std::get_if<double>(&property.value)) {
    color = SceneColor(*real);
  } else {
    color = SceneColor(static_cast<double>(std::get<std::int64_t>(property.value)));
  }
  const glm::dvec3 value = color.rgb();
  for (int i = 0; i < 3; ++i) {
    if (contains(range, value[i])) continue;
    error(name, fmt::format("'{}' is ({}, {}, {}){}", name, value.x, value.y, value.z, property.origin),
          number_range("components", range, value[i]));
    return std::nullopt;
  }
  return color;
}

glm::dvec3 Parameters::read(const PointParameter& point) {
  ask(point, PluginParameter::Type::point,
      fmt::format("{}, {}, {}", point.fallback.x, point.fallback.y, point.fallback.z));
  const Property* property = find_as<Property::Vector>(point.name, "point, vector");
  if (!property) return point.fallback;
  const glm::dvec3 value = to_glm(std::get<Property::Vector>(property->value).value);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(value[i]) <= kMaxCoordinate) continue;
    error(point.name, fmt::format("'{}' is ({}, {}, {}){}", point.name, value.x, value.y, value.z, property->origin),
          fmt::format("coordinates from {:g} to {:g}", -kMaxCoordinate, kMaxCoordinate));
    return point.fallback;
  }
  return value;
}

glm::dmat4 Parameters::read(const TransformParameter& transform) {
  ask(transform, PluginParameter::Type::transform, {});
  const Property* property = find_as<Property::Transform>(transform.name, "transform");
  if (!property) return glm::dmat4(1);
  const glm::dmat4 matrix = to_glm(std::get<Property::Transform>(property->value));
  const auto [complaint, accepted] = complaint_about(matrix, transform.flat);
  if (complaint.empty()) return matrix;
  error(transform.name, fmt::format("'{}' {}", transform.name, complaint), accepted);
  return glm::dmat4(1);
}

std::string Parameters::read(const FileParameter& file) {
  const std::string example = fmt::format("<string name=\"{}\" value=\"...\"/>", file.name);
  ask(TextParameter{.name = file.name, .text = file.text, .example = example}, PluginParameter::Type::file, {});
  if (!has(file.name)) return {};
  const Property* property = find_as<std::string>(file.name, "string");
  if (!property) return {};
  const std::string& value = std::get<std::string>(property->value);
  std::vector<std::string> folders = description_.search_paths;
  folders.push_back(folder_of(property->location.file));
  return find_file(files_, value, folders, property->location, property->origin, diagnostics_);
}

const Node::Child* Parameters::read(const TextureParameter& parameter) {
  ask(parameter, PluginParameter::Type::texture, {});
  const Node::Child* child = texture(parameter.name);
  constexpr std::string_view kAccepted = "a texture that differs from place to place, such as bitmap";
  if (child || !has(parameter.name)) return child;
  if (const Node::Child* of_one_value = find_child(parameter.name);
      of_one_value && is_constant_spectrum(*of_one_value->node)) {
    find(parameter.name);
    error(parameter.name, fmt::format("'{}' is of one value", parameter.name), std::string(kAccepted));
  } else {
    find_as<>(parameter.name, kAccepted);
  }
  return nullptr;
}

const Node::Child* Parameters::read(const VolumeParameter& parameter) {
  ask(parameter, PluginParameter::Type::volume, {});
  if (record_) recorded(parameter.name).is_required = true;
  const Node::Child* child = find_child(parameter.name);
  constexpr std::string_view kAccepted = "a volume, such as gridvolume";
  if (child && child->node->kind == "volume") return child;
  if (!has(parameter.name)) {
    error(parameter.name, fmt::format("{} needs a parameter '{}'", name_of(node_), parameter.name),
          std::string(kAccepted));
  } else {
    find_as<>(parameter.name, kAccepted);
  }
  return nullptr;
}

SceneColor::Spectrum Parameters::read(const SpectrumParameter& spectrum) {
  ask(spectrum, PluginParameter::Type::spectrum, {});
  constexpr std::string_view kAccepted = "a spectrum of wavelength:value pairs";
  const Property* property = find_as<Property::Spectrum>(spectrum.name, kAccepted);
  if (!property) return {};
  const auto& samples = std::get<Property::Spectrum>(property->value).samples;
  if (samples.size() > 1) return samples;
  error(spectrum.name, fmt::format("'{}' is a single value{}", spectrum.name, property->origin),
        std::string(kAccepted));
  return {};
}

}  // namespace norrsken
