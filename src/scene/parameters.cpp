#include "scene/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "base/numbers.h"
#include "base/text.h"
#include "color/spectrum.h"
#include "scene/constant_spectrum.h"
#include "scene/find_file.h"
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
std::string number_range(std::string_view noun, double min, double max, double value, Ends ends = Ends::closed) {
  return range_text(noun, fmt::format("{:g}", min), fmt::format("{:g}", max), min > -kMaxCoordinate || value < min,
                    max < kMaxCoordinate || value > max, ends);
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

Parameters::Parameters(const Node& node, const Description& description, const FileSystem& files,
                       Diagnostics& diagnostics)
    : node_(node), description_(description), files_(files), diagnostics_(diagnostics) {}

bool Parameters::has(std::string_view name) const {
  const auto named = [name](const auto& item) { return item.name == name; };
  return std::any_of(node_.properties.begin(), node_.properties.end(), named) ||
         std::any_of(node_.children.begin(), node_.children.end(), named) ||
         std::find(node_.unreadable.begin(), node_.unreadable.end(), name) != node_.unreadable.end();
}

const Property* Parameters::find(std::string_view name) {
  asked_names_.emplace(name);
  const auto named = [name](const Property& property) { return property.name == name; };
  const auto found = std::find_if(node_.properties.begin(), node_.properties.end(), named);
  return found == node_.properties.end() ? nullptr : &*found;
}

const Node::Child* Parameters::find_child(std::string_view name) const {
  const auto named = [name](const Node::Child& child) { return child.name == name; };
  const auto found = std::find_if(node_.children.begin(), node_.children.end(), named);
  return found == node_.children.end() ? nullptr : &*found;
}

template <typename... Types>
const Property* Parameters::find_value(std::string_view name, std::string_view accepted, Property& storage) {
  const Node::Child* child = find_child(name);
  if (!child || !is_constant_spectrum(*child->node)) return find_as<Types...>(name, accepted);
  asked_names_.emplace(name);
  const auto errors = diagnostics_.error_count();
  Parameters inside(*child->node, description_, files_, diagnostics_);
  storage = read_constant_spectrum(inside);
  inside.finish();
  return diagnostics_.error_count() == errors ? &storage : nullptr;
}

bool Parameters::boolean(std::string_view name, bool fallback) {
  note(name, PluginParameter::Type::boolean, fallback ? "true" : "false");
  const Property* property = find_as<bool>(name, "boolean");
  return property ? std::get<bool>(property->value) : fallback;
}

std::int64_t Parameters::integer(std::string_view name, std::int64_t fallback, std::int64_t min, std::int64_t max) {
  note(name, PluginParameter::Type::integer, std::to_string(fallback));
  note_range(name, static_cast<double>(min), static_cast<double>(max), Ends::closed);
  const Property* property = find_as<std::int64_t>(name, "integer");
  if (!property) return fallback;
  const std::int64_t value = std::get<std::int64_t>(property->value);
  if (value >= min && value <= max) return value;
  using Limits = std::numeric_limits<std::int64_t>;
  error(name, fmt::format("'{}' is {}{}", name, value, property->origin),
        range_text("an integer", std::to_string(min), std::to_string(max), min != Limits::min(), max != Limits::max(),
                   Ends::closed));
  return fallback;
}

double Parameters::number(std::string_view name, double fallback, double min, double max, Ends ends) {
  note(name, PluginParameter::Type::number, fmt::format("{}", fallback));
  note_range(name, min, max, ends);
  Property storage;
  const Property* property = find_value<double, std::int64_t>(name, "float", storage);
  return property ? number_of(*property, name, fallback, min, max, ends) : fallback;
}

double Parameters::mean(std::string_view name, double fallback, double min, double max, Ends ends) {
  note(name, PluginParameter::Type::number, fmt::format("{}", fallback));
  note_range(name, min, max, ends);
  Property storage;
  const Property* property =
      find_value<double, std::int64_t, Property::Rgb, Property::Spectrum>(name, "float, rgb, spectrum", storage);
  return property ? number_of(*property, name, fallback, min, max, ends) : fallback;
}

double Parameters::number_of(const Property& property, std::string_view name, double fallback, double min, double max,
                             Ends ends) {
  min = std::max(min, -kMaxNumber);
  max = std::min(max, kMaxNumber);
  const std::optional<double> known = value_of(property, name);
  if (!known) return fallback;
  const double value = *known;
  const bool is_above = ends == Ends::closed ? value >= min : value > min;
  const bool is_below = ends == Ends::open ? value < max : value <= max;
  if (is_above && is_below) return value;
  const bool is_mean =
      !std::holds_alternative<double>(property.value) && !std::holds_alternative<std::int64_t>(property.value);
  error(name, fmt::format("'{}' is {}{}{}", name, value, is_mean ? " in the mean" : "", property.origin),
        number_range("a number", min, max, value, ends));
  return fallback;
}

std::optional<double> Parameters::value_of(const Property& property, std::string_view name) {
  if (const double* real = std::get_if<double>(&property.value)) return *real;
  if (const std::int64_t* integer = std::get_if<std::int64_t>(&property.value)) return static_cast<double>(*integer);
  const auto rgb = color_of(property, name, -kMaxNumber, kMaxNumber, false);
  if (!rgb) return std::nullopt;
  // The mean of three that are the same is not always the same.
  return rgb->x == rgb->y && rgb->y == rgb->z ? rgb->x : (rgb->x + rgb->y + rgb->z) / 3;
}

double Parameters::number_clamped(std::string_view name, double fallback, double min, double max,
                                  Diagnostic::Severity severity) {
  note(name, PluginParameter::Type::number, fmt::format("{}", fallback));
  note_range(name, min, max, Ends::closed);
  Property storage;
  return clamped(find_value<double, std::int64_t>(name, "float", storage), name, fallback, min, max, severity);
}

double Parameters::mean_clamped(std::string_view name, double fallback, double min, double max) {
  note(name, PluginParameter::Type::number, fmt::format("{}", fallback));
  note_range(name, min, max, Ends::closed);
  Property storage;
  const Property* property =
      find_value<double, std::int64_t, Property::Rgb, Property::Spectrum>(name, "float, rgb, spectrum", storage);
  return clamped(property, name, fallback, min, max, Diagnostic::Severity::warning);
}

double Parameters::clamped(const Property* property, std::string_view name, double fallback, double min, double max,
                           Diagnostic::Severity severity) {
  if (property == nullptr) return fallback;
  const double given = value_of(*property, name).value_or(fallback);
  const double value = std::clamp(given, min, max);
  if (value == given) return value;
  const std::string message =
      fmt::format("'{}' is {:g}{}, which is taken for {:g}", name, given, property->origin, value);
  const std::string accepted = number_range("a number", min, max, given);
  severity == Diagnostic::Severity::note ? diagnostics_.note(where(name), message, accepted)
                                         : diagnostics_.warning(where(name), message, accepted);
  return value;
}

std::string Parameters::text(std::string_view name, std::string_view fallback) {
  note(name, PluginParameter::Type::text, std::string(fallback));
  const Property* property = find_as<std::string>(name, "string");
  return property ? std::get<std::string>(property->value) : std::string(fallback);
}

std::string Parameters::choice(std::string_view name, std::string_view fallback,
                               std::initializer_list<std::string_view> words) {
  const std::vector<std::string> choices(words.begin(), words.end());
  note(name, PluginParameter::Type::text, std::string(fallback));
  if (record_) recorded(name).choices = choices;
  const Property* property = find_as<std::string>(name, "string: " + join(choices));
  if (!property) return std::string(fallback);
  const std::string& value = std::get<std::string>(property->value);
  const auto same = [&](const std::string& word) { return equal_ignoring_case(word, value); };
  if (const auto found = std::ranges::find_if(choices, same); found != choices.end()) return *found;
  error(name, fmt::format("'{}' is {}{}{}", name, quoted(value), property->origin, did_you_mean(value, choices)),
        join(choices));
  return std::string(fallback);
}

const Node::Child* Parameters::texture(std::string_view name) {
  if (record_) recorded(name).may_be_texture = true;
  const Node::Child* child = find_child(name);
  if (!child || !is_spectrum_or_texture(*child->node) || is_constant_spectrum(*child->node)) return nullptr;
  asked_names_.emplace(name);
  return child;
}

glm::dvec3 Parameters::color(std::string_view name, glm::dvec3 fallback, double min, double max, bool emission) {
  const bool is_grey = fallback.x == fallback.y && fallback.y == fallback.z;
  note(name, PluginParameter::Type::color,
       is_grey ? fmt::format("{}", fallback.x) : fmt::format("{}, {}, {}", fallback.x, fallback.y, fallback.z));
  note_range(name, min, max, Ends::closed);
  Property storage;
  const Property* property =
      find_value<Property::Rgb, Property::Spectrum, double, std::int64_t>(name, "rgb, spectrum, float", storage);
  if (!property) return fallback;
  return color_of(*property, name, std::max(min, -kMaxNumber), std::min(max, kMaxNumber), emission).value_or(fallback);
}

std::optional<glm::dvec3> Parameters::color_of(const Property& property, std::string_view name, double min, double max,
                                               bool emission) {
  if (const auto* spectrum = std::get_if<Property::Spectrum>(&property.value)) {
    for (const auto& [wavelength, value] : spectrum->samples) {
      if (value >= min && value <= max) continue;
      error(name, fmt::format("'{}' has a value of {}{}", name, value, property.origin),
            number_range("a spectrum with values", min, max, value));
      return std::nullopt;
    }
    const ColorVector rgb = emission ? rgb_of_emission(spectrum->samples) : rgb_of_reflectance(spectrum->samples);
    // Saturated spectra lie outside sRGB: not the user's fault, the nearest colour must do.
    return glm::clamp(glm::dvec3(rgb[0], rgb[1], rgb[2]), min, max);
  }

  glm::dvec3 value;
  if (const auto* rgb = std::get_if<Property::Rgb>(&property.value)) {
    value = to_glm(rgb->value);
  } else if (const auto* real = std::get_if<double>(&property.value)) {
    value = glm::dvec3(*real);
  } else {
    value = glm::dvec3(static_cast<double>(std::get<std::int64_t>(property.value)));
  }
  for (int i = 0; i < 3; ++i) {
    if (value[i] >= min && value[i] <= max) continue;
    error(name, fmt::format("'{}' is ({}, {}, {}){}", name, value.x, value.y, value.z, property.origin),
          number_range("components", min, max, value[i]));
    return std::nullopt;
  }
  return value;
}

std::vector<std::pair<double, double>> Parameters::spectrum(std::string_view name) {
  note(name, PluginParameter::Type::spectrum);
  constexpr std::string_view kAccepted = "a spectrum of wavelength:value pairs";
  const Property* property = find_as<Property::Spectrum>(name, kAccepted);
  if (!property) return {};
  const auto& samples = std::get<Property::Spectrum>(property->value).samples;
  if (samples.size() > 1) return samples;
  error(name, fmt::format("'{}' is a single value{}", name, property->origin), std::string(kAccepted));
  return {};
}

glm::dvec3 Parameters::point(std::string_view name, glm::dvec3 fallback) {
  note(name, PluginParameter::Type::point, fmt::format("{}, {}, {}", fallback.x, fallback.y, fallback.z));
  const Property* property = find_as<Property::Vector>(name, "point, vector");
  if (!property) return fallback;
  const glm::dvec3 value = to_glm(std::get<Property::Vector>(property->value).value);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(value[i]) <= kMaxCoordinate) continue;
    error(name, fmt::format("'{}' is ({}, {}, {}){}", name, value.x, value.y, value.z, property->origin),
          fmt::format("coordinates from {:g} to {:g}", -kMaxCoordinate, kMaxCoordinate));
    return fallback;
  }
  return value;
}

glm::dmat4 Parameters::transform(std::string_view name, Flat flat) {
  note(name, PluginParameter::Type::transform);
  const Property* property = find_as<Property::Transform>(name, "transform");
  if (!property) return glm::dmat4(1);
  const glm::dmat4 matrix = to_glm(std::get<Property::Transform>(property->value));
  const auto [complaint, accepted] = complaint_about(matrix, flat);
  if (complaint.empty()) return matrix;
  error(name, fmt::format("'{}' {}", name, complaint), accepted);
  return glm::dmat4(1);
}

std::string Parameters::file(std::string_view name) {
  note(name, PluginParameter::Type::file);
  if (!require(name, fmt::format("<string name=\"{}\" value=\"...\"/>", name))) return {};
  const Property* property = find_as<std::string>(name, "string");
  if (!property) return {};
  const std::string& value = std::get<std::string>(property->value);
  std::vector<std::string> folders = description_.search_paths;
  folders.push_back(folder_of(property->location.file));
  return find_file(files_, value, folders, property->location, property->origin, diagnostics_);
}

std::vector<const Node::Child*> Parameters::children(std::string_view kind) {
  asked_kinds_.emplace(kind);
  if (record_ && std::ranges::find(record_->children, kind) == record_->children.end())
    record_->children.emplace_back(kind);
  std::vector<const Node::Child*> found;
  for (const Node::Child& child : node_.children) {
    if (child.node->kind == kind) found.push_back(&child);
  }
  return found;
}

const Node::Child* Parameters::child(std::string_view kind) {
  const auto found = children(kind);
  if (found.size() > 1)
    diagnostics_.error(found[1]->location, fmt::format("{} has more than one {}", name_of(node_), kind),
                       fmt::format("one {}", kind));
  return found.empty() ? nullptr : found[0];
}

bool Parameters::require(std::string_view name, std::string_view example) {
  if (record_) {
    recorded(name).is_required = true;
    recorded(name).fallback.clear();
  }
  if (has(name)) return true;
  asked_names_.emplace(name);
  error(name, fmt::format("{} needs a parameter '{}'", name_of(node_), name), std::string(example));
  return false;
}

PluginParameter& Parameters::recorded(std::string_view name) {
  auto& parameters = record_->parameters;
  const auto known = std::ranges::find(parameters, name, &PluginParameter::name);
  if (known != parameters.end()) return *known;
  PluginParameter& added = parameters.emplace_back();
  added.name = name;
  return added;
}

void Parameters::note(std::string_view name, PluginParameter::Type type, std::string fallback) {
  if (!record_) return;
  PluginParameter& parameter = recorded(name);
  parameter.type = type;
  if (!parameter.is_required) parameter.fallback = std::move(fallback);
}

void Parameters::note_range(std::string_view name, double min, double max, Ends ends) {
  if (!record_) return;
  PluginParameter& parameter = recorded(name);
  // Bounds that only say what the program can calculate with are none.
  if (min > -kMaxCoordinate) parameter.min = min;
  if (max < kMaxCoordinate) parameter.max = max;
  parameter.min_belongs = ends == Ends::closed, parameter.max_belongs = ends != Ends::open;
}

SourceLocation Parameters::where(std::string_view name) const {
  for (const Property& property : node_.properties) {
    if (property.name == name) return property.location;
  }
  for (const Node::Child& child : node_.children) {
    if (child.name == name) return child.location;
  }
  return node_.location;
}

void Parameters::error(std::string_view name, std::string message, std::string accepted) {
  diagnostics_.error(where(name), std::move(message), std::move(accepted));
}

}  // namespace norrsken
