#include "formats/reader_testing.h"

#include <fmt/format.h>

#include <algorithm>

namespace norrsken {
namespace {

struct Visitor {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return fmt::format("{:.9g}", value); }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(const Property::Rgb& rgb) const {
    return fmt::format("rgb {:.6g} {:.6g} {:.6g}", rgb.value[0], rgb.value[1], rgb.value[2]);
  }
  std::string operator()(const Property::Spectrum& spectrum) const {
    std::string text = "spectrum";
    for (const auto& [wavelength, value] : spectrum.samples) text += fmt::format(" {:g}:{:.6g}", wavelength, value);
    return text;
  }
  std::string operator()(const Property::Vector& v) const {
    return fmt::format("{:g} {:g} {:g}", v.value[0], v.value[1], v.value[2]);
  }
  std::string operator()(const Property::Transform& m) const {
    std::string text = "matrix";
    for (const auto& row : m.rows) {
      // Adding 0 takes the sign from zeros.
      for (const double element : row) text += fmt::format(" {:.6g}", element + 0.0);
    }
    return text;
  }
  template <class Shared>
  std::string operator()(const std::shared_ptr<const Shared>&) const {
    return "an array";  // no file has one
  }
};

std::string text_of(const Property& property) { return property.name + " = " + std::visit(Visitor{}, property.value); }

std::string text_of(const Node& node, const std::string& name, const std::string& indent) {
  std::string text = fmt::format("{}{} {} '{}'\n", indent, node.kind, node.plugin, name);
  std::vector<std::string> lines;
  for (const Property& property : node.properties) lines.push_back(text_of(property));
  std::ranges::sort(lines);
  for (const std::string& line : lines) text += indent + "  " + line + "\n";
  for (const Node::Child& child : node.children) text += text_of(*child.node, child.name, indent + "  ");
  return text;
}

}  // namespace

std::string text_of(const Node& node) { return text_of(node, {}, {}); }

// Tests know no built-in files.
std::vector<std::pair<std::string_view, std::string_view>> builtin_files() { return {}; }

std::optional<Description> read_scene(const TestFiles& files, const TestParameters& parameters,
                                      Diagnostics& diagnostics) {
  return read_mitsuba_xml("room.xml", MemoryFiles(files), parameters, diagnostics);
}

std::optional<Description> read_scene(const std::string& xml, const TestParameters& parameters,
                                      Diagnostics& diagnostics) {
  return read_scene(TestFiles{{"room.xml", xml}}, parameters, diagnostics);
}

std::string to_text(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.all()) text += (text.empty() ? "" : "\n") + to_text(diagnostic);
  return text;
}

std::string complaints_about(const TestFiles& files, const TestParameters& parameters) {
  Diagnostics diagnostics;
  read_scene(files, parameters, diagnostics);
  return to_text(diagnostics);
}

std::string complaints_about(const std::string& xml, const TestParameters& parameters) {
  return complaints_about(TestFiles{{"room.xml", xml}}, parameters);
}

}  // namespace norrsken
