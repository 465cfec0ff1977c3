// Values for the parameters of plugins, by rules from what plugins() tells of them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "norrsken/plugins.h"
#include "tests/end_to_end/plugin_values.h"

namespace norrsken::testing {

using Type = PluginParameter::Type;

inline const Value* value_of(const std::string& plugin, const PluginParameter& parameter) {
  const auto* found = std::ranges::find_if(kValues, [&](const Value& value) {
    return (value.plugin[0] == 0 || value.plugin == plugin) && value.parameter == parameter.name;
  });
  return found == std::end(kValues) ? nullptr : found;
}

/// The element that a scene file has for a parameter of that type.
inline std::string tag_of(Type type) {
  switch (type) {
    case Type::boolean:
      return "boolean";
    case Type::integer:
      return "integer";
    case Type::number:
      return "float";
    case Type::color:
      return "rgb";
    case Type::spectrum:
      return "spectrum";
    case Type::point:
      return "point";
    case Type::transform:
      return "transform";
    case Type::texture:
      return "texture";
    case Type::volume:
      return "volume";
    default:
      return "string";
  }
}

inline std::string element(const std::string& tag, const std::string& name, const std::string& value) {
  if (tag == "transform") return fmt::format(R"(<transform name="{}">{}</transform>)", name, value);
  if (tag == "volume") return fmt::format(R"(<volume name="{}" type="constvolume"/>)", name);
  if (tag == "texture") return fmt::format(R"(<texture name="{}" type="checkerboard"/>)", name);
  return fmt::format(R"(<{} name="{}" value="{}"/>)", tag, name, value);
}

/// In range, and not the fallback.
inline std::string number_in_range(const PluginParameter& p) {
  const double fallback = p.fallback.empty() ? 0 : std::stod(p.fallback);
  if (p.type == Type::integer) {
    const double next = fallback + 1;
    const bool fits = !(p.max && next > *p.max) && !(p.min && next < *p.min);
    return fmt::format("{}", static_cast<std::int64_t>(fits ? next : p.min.value_or(0)));
  }
  if (fallback != 0) return fmt::format("{}", 0.9 * fallback);
  return fmt::format("{}", p.min.value_or(0) + (p.max ? (*p.max - p.min.value_or(0)) / 4 : 1));
}

inline std::string right_value(const std::string& plugin, const PluginParameter& p) {
  if (const Value* value = value_of(plugin, p)) return value->right;
  switch (p.type) {
    case Type::boolean:
      return p.fallback == "true" ? "false" : "true";
    case Type::integer:
    case Type::number:
      return number_in_range(p);
    case Type::color:
      return "0.25, 0.5, 0.75";
    case Type::point:
      return "1, 2, 3";
    case Type::transform:
      return R"(<rotate z="1" angle="90"/>)";
    default:
      return p.choices.empty() ? "" : p.choices.back();
  }
}

inline std::string right_element(const std::string& plugin, const PluginParameter& p) {
  return element(tag_of(p.type), p.name, right_value(plugin, p));
}

/// A value that is not accepted, what the complaint has to name, and what it says is.
struct Wrong {
  std::string value, named, accepted;
  bool is_clamped = false;
};

/// "a number above 0 and at most 100"
inline std::string in_words(const PluginParameter& p) {
  const bool is_integer = p.type == Type::integer;
  const std::string noun = is_integer ? "an integer" : p.type == Type::color ? "components" : "a number";
  const auto text = [&](double bound) {
    return is_integer ? std::to_string(static_cast<std::int64_t>(bound)) : fmt::format("{:g}", bound);
  };
  if (p.min && p.max && p.min_belongs) return fmt::format("{} from {} to {}", noun, text(*p.min), text(*p.max));
  std::string words = noun;
  if (p.min) words += (p.min_belongs ? " of at least " : " above ") + text(*p.min);
  if (p.max) words += (p.min ? " and " : " ") + std::string(p.max_belongs ? "at most " : "below ") + text(*p.max);
  return words;
}

inline std::vector<Wrong> wrong_values(const std::string& plugin, const PluginParameter& p) {
  const Value* value = value_of(plugin, p);
  if (value && value->wrong[0] != 0) return {{value->wrong, value->wrong, value->accepted}};
  std::vector<Wrong> wrong;
  if (p.type == Type::transform) return {{R"(<translate x="1e13"/>)", p.name, "elements up to 1e+12"}};
  if (!p.choices.empty()) return {{"zzz", "zzz", fmt::format("{}", fmt::join(p.choices, ", "))}};
  const auto add = [&](double number) {
    const std::string text =
        p.type == Type::integer ? std::to_string(static_cast<std::int64_t>(number)) : fmt::format("{}", number);
    wrong.push_back({p.type == Type::color ? "0.5, " + text + ", 0.5" : text, text, in_words(p), p.is_clamped});
  };
  if (p.min) add(p.min_belongs ? *p.min - 1 : *p.min);
  if (p.max) add(p.max_belongs ? *p.max + 1 : *p.max);
  return wrong;
}

}  // namespace norrsken::testing
