// Prints what plugins() of the library tells, as JSON: what scripts/make_scene_docs.py makes the tables of docs/scenes.md
// from.
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "norrsken/plugins.h"

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string list(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) out += (out.size() > 1 ? ", " : "") + quoted(text);
  return out + "]";
}

std::string number(const std::optional<double>& value) {
  if (!value) return "null";
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", *value);
  return text;
}

const char* name_of(norrsken::PluginParameter::Type type) {
  const char* const names[] = {"boolean", "integer",  "number", "string",    "path",    "numbers",
                               "color",   "spectrum", "point",  "transform", "texture", "volume"};
  return names[static_cast<int>(type)];
}

void print(const norrsken::PluginParameter& p) {
  std::printf(
      "    {\"name\": %s, \"type\": \"%s\", \"texture\": %s, \"volume\": %s, \"required\": %s, \"default\": %s, "
      "\"choices\": %s,\n",
      quoted(p.name).c_str(), name_of(p.type), p.may_be_texture ? "true" : "false", p.may_be_volume ? "true" : "false",
      p.is_required ? "true" : "false", quoted(p.fallback).c_str(), list(p.choices).c_str());
  std::printf("     \"min\": %s, \"max\": %s, \"min_belongs\": %s, \"max_belongs\": %s, \"clamped\": %s,\n",
              number(p.min).c_str(), number(p.max).c_str(), p.min_belongs ? "true" : "false",
              p.max_belongs ? "true" : "false", p.is_clamped ? "true" : "false");
  std::printf("     \"unit\": %s, \"in_place_of\": %s, \"text\": %s}", quoted(p.unit).c_str(),
              quoted(p.in_place_of).c_str(), quoted(p.text).c_str());
}

}  // namespace

int main() {
  const char* separator = "[";
  for (const norrsken::PluginInfo& plugin : norrsken::plugins()) {
    std::printf("%s\n  {\"kind\": %s, \"name\": %s, \"parameters\": [", separator, quoted(plugin.kind).c_str(),
                quoted(plugin.name).c_str());
    const char* comma = "\n";
    for (const norrsken::PluginParameter& parameter : plugin.parameters) {
      std::fputs(comma, stdout);
      print(parameter);
      comma = ",\n";
    }
    std::fputs("]}", stdout);
    separator = ",";
  }
  std::puts("\n]");
}
