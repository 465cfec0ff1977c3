#include "bsdf/ior_host.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.h"

namespace norrsken {
namespace {

constexpr double kMaxIor = 100;

struct NamedIor {
  std::string_view name;
  double value;
};

// The names of Mitsuba 3 and their values at 589 nm, 0 to 20 degrees Celsius.
// Source: Hecht, "Optics", 4th edition, tables 4.1 and 3.2.
constexpr NamedIor kNamed[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.575},       {"diamond", 2.419},
};

const NamedIor* find_named(std::string_view name) {
  const auto found = std::find_if(std::begin(kNamed), std::end(kNamed),
                                  [&](const NamedIor& n) { return equal_ignoring_case(n.name, name); });
  return found == std::end(kNamed) ? nullptr : found;
}

double read_ior(Parameters& p, const IorParameter& ior) {
  const NumberParameter number{
      .name = ior.name, .fallback = find_named(ior.fallback)->value, .range = above(0, kMaxIor), .text = ior.text};
  const auto& properties = p.node().properties;
  const auto given = std::ranges::find(properties, ior.name, &Property::name);
  if (given == properties.end() || !std::holds_alternative<std::string>(given->value)) return p.read(number);
  const std::string material = p.read(TextParameter{.name = ior.name, .text = ior.text});
  if (const NamedIor* named = find_named(material)) return named->value;
  std::vector<std::string> names;
  for (const NamedIor& n : kNamed) names.emplace_back(n.name);
  p.error(ior.name,
          fmt::format("'{}' is {}{}{}", ior.name, quoted(material), given->origin, did_you_mean(material, names)),
          "a number, or " + join(names));
  return number.fallback;
}

}  // namespace

double read_relative_ior(Parameters& p, const IorParameter& inside, const IorParameter& outside) {
  const double of_inside = read_ior(p, inside), of_outside = read_ior(p, outside);
  return of_inside / of_outside;
}

void refuse_same_ior(Parameters& p, const IorParameter& inside, const IorParameter& outside) {
  p.error(p.has(inside.name) ? inside.name : outside.name, "the indices of refraction of both sides are the same",
          fmt::format("{} and {} that differ", inside.name, outside.name));
}

}  // namespace norrsken
