#include "formats/pbrt/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"

namespace norrsken::pbrt {

const Parameter* Parameters::find(std::string_view type, std::string_view name) { return find({type}, name); }

const Parameter* Parameters::find(std::initializer_list<std::string_view> types, std::string_view name) {
  for (const std::string_view type : types) {
    std::string declaration = fmt::format("{} {}", type, name);
    if (std::ranges::find(accepted_, declaration) == accepted_.end()) accepted_.push_back(std::move(declaration));
  }
  const Parameter* found = nullptr;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const Parameter& parameter = *parameters_[i];
    if (parameter.name != name || std::ranges::find(types, parameter.type) == types.end()) continue;
    asked_[i] = true;
    found = &parameter;
  }
  return found;
}

bool Parameters::has(std::string_view name) const {
  return std::ranges::any_of(parameters_, [name](const auto& parameter) { return parameter->name == name; });
}

bool Parameters::depends_on_uv() const {
  return std::ranges::any_of(parameters_, [](const auto& parameter) {
    return parameter->type == "texture" || parameter->name == "normalmap" || parameter->name.ends_with("uroughness") ||
           parameter->name.ends_with("vroughness");
  });
}

bool Parameters::has_values(const Parameter& parameter, std::size_t count) {
  const std::size_t given = std::max(parameter.numbers.size(), parameter.strings.size());
  if (given == count) return true;
  error(&parameter, fmt::format("'{}' of {} has {} value{}", parameter.name, object_, given, given == 1 ? "" : "s"),
        fmt::format("{} of them", count));
  return false;
}

const Parameter* Parameters::ranged(std::string_view type, std::string_view name, double min, double max, bool above) {
  const Parameter* parameter = find(type, name);
  if (!parameter || !has_values(*parameter, 1)) return nullptr;
  const double value = parameter->numbers[0];
  if (value >= min && value <= max && !(above && value == min)) return parameter;
  const std::string lower = std::isfinite(min) ? fmt::format("{} {:g}", above ? "above" : "from", min) : std::string();
  const std::string upper = std::isfinite(max) ? fmt::format("up to {:g}", max) : std::string();
  error(parameter, fmt::format("'{}' of {} is {:g}", name, object_, value),
        fmt::format("a number {}{}{}", lower, lower.empty() || upper.empty() ? "" : " ", upper));
  return nullptr;
}

double Parameters::number(std::string_view name, double fallback, double min, double max) {
  const Parameter* parameter = ranged("float", name, min, max, /*above=*/false);
  return parameter ? parameter->numbers[0] : fallback;
}

double Parameters::positive(std::string_view name, double fallback) {
  const Parameter* parameter = ranged("float", name, 0, kInfinity, /*above=*/true);
  return parameter ? parameter->numbers[0] : fallback;
}

std::int64_t Parameters::integer(std::string_view name, std::int64_t fallback, std::int64_t min, std::int64_t max) {
  const Parameter* parameter =
      ranged("integer", name, static_cast<double>(min), static_cast<double>(max), /*above=*/false);
  return parameter ? static_cast<std::int64_t>(parameter->numbers[0]) : fallback;
}

bool Parameters::flag(std::string_view name, bool fallback) {
  const Parameter* parameter = find("bool", name);
  return parameter && has_values(*parameter, 1) ? parameter->numbers[0] != 0 : fallback;
}

std::string Parameters::text(std::string_view name, std::string_view fallback) {
  const Parameter* parameter = find("string", name);
  return parameter && has_values(*parameter, 1) ? parameter->strings[0] : std::string(fallback);
}

std::string Parameters::choice(std::string_view name, std::string_view fallback,
                               std::initializer_list<std::string_view> words) {
  std::string word = text(name, fallback);
  if (std::ranges::find(words, word) != words.end() || word == fallback) return word;
  const std::vector<std::string> known(words.begin(), words.end());
  error(find("string", name),
        fmt::format("unknown {} {} of {}{}", name, quoted(word), object_, did_you_mean(word, known)), join(known));
  return std::string(fallback);
}

std::optional<glm::dvec3> Parameters::vector(std::string_view type, std::string_view name) {
  const Parameter* parameter = find(type, name);
  if (!parameter || !has_values(*parameter, 3)) return std::nullopt;
  return glm::dvec3(parameter->numbers[0], parameter->numbers[1], parameter->numbers[2]);
}

const Array<double>* Parameters::list(std::string_view type, std::string_view name, std::size_t per_element) {
  const Parameter* parameter = find(type, name);
  if (!parameter) return nullptr;
  if (parameter->numbers.size() % per_element == 0) return &parameter->numbers;
  error(parameter, fmt::format("'{}' of {} has {} numbers", name, object_, parameter->numbers.size()),
        fmt::format("a multiple of {}", per_element));
  return nullptr;
}

void Parameters::error(const Parameter* at, std::string message, std::string accepted) {
  diagnostics_->error((at ? at->place : place_).location(), std::move(message), std::move(accepted));
}

void Parameters::note(const Parameter* at, std::string message, std::string accepted) {
  diagnostics_->note((at ? at->place : place_).location(), std::move(message), std::move(accepted));
}

void Parameters::finish() {
  std::ranges::sort(accepted_);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const Parameter& parameter = *parameters_[i];
    // One that another of its name stands in for, in this object or over an Attribute, is not missed.
    if (asked_[i] || parameter.given) continue;
    const std::string declaration = parameter.type + " " + parameter.name;
    error(&parameter,
          fmt::format("{} has no parameter {}{}", object_, quoted(declaration), did_you_mean(declaration, accepted_)),
          join(accepted_));
  }
}

}  // namespace norrsken::pbrt
