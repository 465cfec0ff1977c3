#include "formats/mitsuba_property.h"

#include <fmt/format.h>

#include <utility>

#include "base/text.h"
#include "formats/mitsuba_values.h"
#include "scene/find_file.h"

namespace norrsken {
namespace {

std::optional<Property::Spectrum> read_spectrum_element(const MitsubaContext& context, const Element& element) {
  const Literal* value = element.find("value");
  const Literal* filename = element.find("filename");
  if ((value == nullptr) == (filename == nullptr)) {
    context.diagnostics.error(element.location, "<spectrum> needs either 'value' or 'filename'",
                              "value=\"0.5\", value=\"400:0.1, 700:0.8\", filename=\"measured.spd\"");
    return std::nullopt;
  }
  if (value) return read_spectrum(*value, context.diagnostics);
  const std::string path = context.find_file(*filename);
  if (path.empty()) return std::nullopt;
  std::string error;
  const auto contents = context.files.read(path, error);
  context.diagnostics.named_at(path, filename->location());
  if (contents) return read_spectrum_file(SourceText(path, *contents), context.diagnostics);
  context.diagnostics.error(filename->location(), fmt::format("cannot read {}: {}", quoted(path, 200), error),
                            "a text file of wavelengths and values");
  return std::nullopt;
}

// Three numbers and no wavelengths: in Mitsuba 0.x, which counted in RGB, a colour.
bool is_triple(const Element& element) {
  const std::string value = element.text("value");
  return value.find(':') == std::string::npos && split(value, " \t\r\n,").size() == 3;
}

// The first step is applied first: each one multiplies from the left.
std::optional<Property::Transform> read_transform(MitsubaContext& context, const XmlDocument& document,
                                                  pugi::xml_node xml) {
  glm::dmat4 result(1);
  bool good = true;
  for (const pugi::xml_node child : xml.children()) {
    if (context.gave_up()) return std::nullopt;
    const std::string name = context.upgrade.element(document, child);
    const auto rules = transform_step_rules(name);
    if (!rules) {
      good = false;
      const bool element = child.type() == pugi::node_element;
      context.diagnostics.error(document.location(child),
                                element ? fmt::format("unknown step {} in a <transform>{}", quoted(child.name()),
                                                      did_you_mean(child.name(), transform_step_names()))
                                        : "text in <transform>",
                                join(transform_step_names()));
      continue;
    }
    Element step = context.open(document, child, *rules);
    step.name = name;
    context.refuse_contents(document, child);
    const RotationAxis axis = context.upgrade.version.is_old() ? RotationAxis::direction : RotationAxis::as_given;
    const auto matrix = step.good ? read_transform_step(step, axis, context.diagnostics) : std::nullopt;
    good = good && matrix;
    if (matrix) result = *matrix * result;
  }
  return good ? std::optional(to_transform(result)) : std::nullopt;
}

// Gives the property its value; false after a complaint.
bool fill(Property& property, MitsubaContext& context, const XmlDocument& document, pugi::xml_node xml,
          const Element& element) {
  const auto put = [&property](auto&& value) {
    if (value) property.value = std::move(*value);
    return value.has_value();
  };
  const std::string& type = property.type;
  const bool is_old = context.upgrade.version.is_old();
  if (type == "blackbody") return put(read_blackbody(element, context.diagnostics));
  if (type == "spectrum" && is_old && is_triple(element))
    return put(read_rgb(*element.find("value"), HexColor::linear, context.diagnostics));
  if (type == "spectrum") return put(read_spectrum_element(context, element));
  if (type == "transform") return put(read_transform(context, document, xml));
  if (type == "point" || type == "vector") {
    const auto value = read_coordinates(element, std::nullopt, context.diagnostics);
    if (value) property.value = Property::Vector{to_array(*value)};
    return value.has_value();
  }
  const Literal& value = *element.find("value");
  if (type == "boolean") return put(read_boolean(value, context.diagnostics));
  if (type == "integer") return put(read_integer(value, context.diagnostics));
  if (type == "float") return put(read_float(value, context.diagnostics));
  if (type == "rgb") return put(read_rgb(value, is_old ? HexColor::linear : HexColor::srgb, context.diagnostics));
  if (type == "srgb") return put(read_srgb(value, context.diagnostics));
  property.value = value.text;
  return true;
}

}  // namespace

void MitsubaContext::refuse_contents(const XmlDocument& document, pugi::xml_node node) const {
  if (const pugi::xml_node child = node.first_child())
    diagnostics.error(document.location(child), fmt::format("<{}> has contents", node.name()),
                      fmt::format("<{} .../>", node.name()));
}

std::string MitsubaContext::find_file(const Literal& name) const {
  return norrsken::find_file(files, name.text, file_folders, name.location(), name.origin, diagnostics);
}

const std::vector<std::string>& value_types() {
  static const std::vector<std::string> types = {"boolean", "float",    "integer",   "point", "rgb",
                                                 "string",  "spectrum", "transform", "vector"};
  return types;
}

const std::vector<std::string>& old_value_types() {
  static const std::vector<std::string> types = {"blackbody", "srgb"};
  return types;
}

AttributeRules value_rules(std::string_view type, SceneVersion version) {
  if (type == "blackbody") return {{"name", "temperature"}, {version.is_before(4) ? "multiplier" : "scale"}};
  // Colours of lights and of surfaces were told apart for the sake of spectral rendering.
  if (type == "rgb" && version.is_old()) return {{"name", "value"}, {"intent"}};
  if (type == "spectrum" && version.is_old()) return {{"name"}, {"value", "filename", "intent"}};
  if (type == "point" || type == "vector") return {{"name"}, {"value", "x", "y", "z"}};
  if (type == "spectrum") return {{"name"}, {"value", "filename"}};
  if (type == "transform") return {{"name"}, {}};
  return {{"name", "value"}, {}};
}

std::optional<Property> read_property(MitsubaContext& context, const XmlDocument& document, pugi::xml_node xml,
                                      const Element& element, const std::string& name) {
  Property property;
  property.type = element.name;
  property.location = element.location;
  for (const char* attribute : {"x", "filename", "temperature", "value"}) {
    if (const Literal* value = element.find(attribute)) property.location = value->location();
  }
  for (const Literal& attribute : element.attributes) {
    if (attribute.name != "name" && property.origin.empty()) property.origin = attribute.origin;
  }
  if (property.type != "transform") context.refuse_contents(document, xml);
  if (!element.good || !fill(property, context, document, xml, element)) return std::nullopt;
  const Literal& written = *element.find("name");
  property.name = name;
  if (written.text != name) property.written = written.text;
  property.name_location = written.location();
  return property;
}

}  // namespace norrsken
