// The part of the upgrade of old scenes that is about textures.
#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/text.h"
#include "formats/mitsuba_upgrade.h"
#include "formats/mitsuba_upgrade_node.h"

namespace norrsken {

using namespace upgrade;

void MitsubaUpgrade::upgrade_texture(Node& node) {
  const auto value = [&node](const char* name, double fallback) {
    const Property* property = find(node, name);
    return property ? number_of(*property) : fallback;
  };
  if (node.plugin == "vertexcolors") {
    node.plugin = "mesh_attribute";
    add_property(node, "name", "string", std::string("vertex_color"));
    warn(node.plugin_location,
         "texture 'vertexcolors' is the 'mesh_attribute' vertex_color, of linear values; Mitsuba 0.6 took those of PLY "
         "files "
         "as sRGB unless 'srgb' was false");
  }
  if (node.plugin == "bitmap") upgrade_bitmap(node);
  if (node.plugin == "scale") upgrade_scale_texture(node);

  const glm::dvec3 scale(value("uscale", 1), value("vscale", 1), 1);
  const glm::dvec3 offset(value("uoffset", 0), value("voffset", 0), 0);
  const Property* first = nullptr;
  for (const char* name : {"uscale", "vscale", "uoffset", "voffset"}) {
    if (const Property* property = find(node, name); property && !first) first = property;
  }
  if (!first || has(node, "to_uv")) return;
  Property to_uv = *first;
  if (scale * offset != offset) {
    warn(first->location,
         "texture coordinates are moved before they are scaled, as in Mitsuba 3; in Mitsuba 0.6 it was after");
  } else {
    note(first->location, "'uscale', 'vscale', 'uoffset' and 'voffset' are 'to_uv'");
  }
  to_uv.name = "to_uv", to_uv.type = "transform", to_uv.written = first->name;
  to_uv.value = to_transform(glm::translate(glm::scale(glm::dmat4(1), scale), offset));
  for (const char* name : {"uscale", "vscale", "uoffset", "voffset"}) remove(node, name);
  node.properties.push_back(std::move(to_uv));
}

void MitsubaUpgrade::upgrade_bitmap(Node& node) {
  const Property* u = find(node, "wrap_mode_u");
  const Property* v = find(node, "wrap_mode_v");
  if (u && v && text_of(*u) == text_of(*v)) {
    note(u->name_location, "'wrapModeU' and 'wrapModeV' are 'wrap_mode'");
    Property both = *u;
    both.name = "wrap_mode";
    for (const char* name : {"wrap_mode", "wrap_mode_u", "wrap_mode_v"}) remove(node, name);
    node.properties.push_back(std::move(both));
  }
  for (Property& property : node.properties) {
    if (property.name != "filter_type" || !is_among(text_of(property), "ewa trilinear")) continue;
    note(property.location, fmt::format("{} is 'bilinear'", quoted(text_of(property))));
    property.value = std::string("bilinear");
  }
  const Property* gamma = find(node, "gamma");
  if (!gamma) return;
  const double value = number_of(*gamma);
  if (value == 1) {
    note(gamma->location, "'gamma' of 1 is 'raw'");
    if (!has(node, "raw")) add_property(node, "raw", "boolean", true);
  } else if (std::abs(value - 2.2) < 0.01) {
    warn(gamma->location, "'gamma' of 2.2 is the curve of sRGB");
  } else if (value != -1) {
    return;  // stays, and is complained about
  }
  remove(node, "gamma");
}

// A constant or a checkerboard is multiplied out, and a factor of 1 vanishes; others are left, and complained about.
void MitsubaUpgrade::upgrade_scale_texture(Node& node) {
  const Property* factor = find(node, "scale");
  if (factor && !std::get_if<double>(&factor->value) && !std::get_if<std::int64_t>(&factor->value)) return;
  const double scale = factor ? number_of(*factor) : 1;
  const auto inside = children_of_kind(node, "texture");
  if (inside.size() == 1) {
    const Node& inner = *node.children[inside[0]].node;
    const bool is_checkerboard = inner.plugin == "checkerboard" && children_of_kind(inner, "texture").empty();
    if (scale != 1 && !is_checkerboard) return;
    note(node.plugin_location, scale == 1 ? "texture 'scale' by 1 is what is inside of it"
                                          : "texture 'scale' of a checkerboard is multiplied out");
    become(node, inner);
    if (scale == 1) return;
    for (const auto& [name, by_default] : {std::pair("color0", 0.4), std::pair("color1", 0.2)}) {
      if (!has(node, name)) add_property(node, name, "float", by_default);
    }
    for (Property& property : node.properties) {
      if (is_among(property.name, "color0 color1")) multiply(property, scale);
    }
    return;
  }
  const Property* value = find(node, "value");
  if (!value) return;
  Property constant = *value;
  multiply(constant, scale);
  note(node.plugin_location, "texture 'scale' of a constant is multiplied out");
  node.plugin = "rawconstant";
  remove(node, "scale");
  remove(node, "value");
  node.properties.push_back(std::move(constant));
}

}  // namespace norrsken
