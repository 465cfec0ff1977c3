// The parameters that have many values: numbers in strings, arrays, meshes and images of programs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "base/text.h"
#include "scene/parameters.h"
#include "scene/parameters_find.h"

namespace norrsken {

template <class T>
std::shared_ptr<const T> Parameters::shared(std::string_view name, std::string_view accepted) {
  const Property* property = find_as<std::shared_ptr<const T>>(name, accepted);
  if (!property) return nullptr;
  const auto& value = std::get<std::shared_ptr<const T>>(property->value);
  if (!value) error(name, fmt::format("'{}' is null", name), std::string(accepted));
  return value;
}
template std::shared_ptr<const Mesh> Parameters::shared<Mesh>(std::string_view, std::string_view);
template std::shared_ptr<const Image> Parameters::shared<Image>(std::string_view, std::string_view);

std::vector<double> Parameters::read(const NumbersParameter& numbers) {
  ask(numbers, PluginParameter::Type::numbers, {});
  const std::string_view name = numbers.name;
  constexpr std::string_view kAccepted = "a string of numbers";
  const Property* property = find_as<std::string, std::shared_ptr<const FloatArray>>(name, kAccepted);
  if (!property) return {};
  std::vector<double> values;
  if (const auto* array = std::get_if<std::shared_ptr<const FloatArray>>(&property->value)) {
    if (*array) values.assign((*array)->begin(), (*array)->end());
    const bool finite = std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
    if (values.empty() || !finite) {
      error(name, fmt::format("'{}' {}", name, values.empty() ? "is empty" : "has a number that is not finite"),
            "finite numbers");
      return {};
    }
    return values;
  }
  for (const TextPiece& piece : split(std::get<std::string>(property->value), " \t\r\n,")) {
    const NumberStatus status = parse_number(piece.text, values.emplace_back());
    if (status == NumberStatus::ok) continue;
    error(name, fmt::format("{} in '{}'{} {}", quoted(piece.text), name, property->origin, describe(status)),
          std::string(kAccepted));
    return {};
  }
  if (values.empty()) error(name, fmt::format("'{}' is empty{}", name, property->origin), std::string(kAccepted));
  return values;
}

Array<float> Parameters::floats(const NumbersParameter& numbers) {
  const std::string_view name = numbers.name;
  const std::size_t per_element = numbers.per_element;
  Array<float> values;
  for (const double number : read(numbers)) {
    if (std::abs(number) <= kMaxCoordinate) {
      values.push_back(static_cast<float>(number));
      continue;
    }
    error(name, fmt::format("'{}' has {}", name, number), fmt::format("{:g} to {:g}", -kMaxCoordinate, kMaxCoordinate));
    return {};
  }
  if (values.size() % per_element == 0) return values;
  error(name, fmt::format("'{}' has {} numbers", name, values.size()), fmt::format("a multiple of {}", per_element));
  return {};
}

Array<std::uint32_t> Parameters::indices(const NumbersParameter& numbers) {
  const std::string_view name = numbers.name;
  const std::size_t per_element = numbers.per_element;
  Array<std::uint32_t> values;
  const Property* property = find(name);
  if (property && std::holds_alternative<std::shared_ptr<const IndexArray>>(property->value)) {
    ask(numbers, PluginParameter::Type::numbers, {});
    if (const auto& array = std::get<std::shared_ptr<const IndexArray>>(property->value))
      values.assign(array->begin(), array->end());
    if (values.empty()) error(name, fmt::format("'{}' is empty", name), "whole numbers");
  } else {
    for (const double number : read(numbers)) {
      if (number >= 0 && number < double{1u << 31} && number == std::floor(number)) {
        values.push_back(static_cast<std::uint32_t>(number));
        continue;
      }
      error(name, fmt::format("'{}' has {}", name, number), "whole numbers from 0 on");
      return {};
    }
  }
  if (values.size() % per_element == 0) return values;
  error(name, fmt::format("'{}' has {} numbers", name, values.size()), fmt::format("a multiple of {}", per_element));
  return {};
}

}  // namespace norrsken
