#include "formats/mitsuba_upgrade.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "formats/mitsuba_upgrade_node.h"
#include "formats/mitsuba_upgrade_rules.h"
#include "formats/mitsuba_values.h"

namespace norrsken {
namespace {

using namespace upgrade;

constexpr std::size_t kMaxChanges = 10000;

bool applies(int before, SceneVersion version) { return before == kAllOld || version.is_before(before); }

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }

// intIOR becomes int_ior: a run of capitals behind a small letter is one word, as in Mitsuba 3.
std::string snake_case(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (i == 0 || !is_upper(name[i]) || !(name[i - 1] >= 'a' && name[i - 1] <= 'z')) {
      result += name[i];
      continue;
    }
    result += '_';
    for (; i < name.size() && is_upper(name[i]); ++i) result += static_cast<char>(name[i] - 'A' + 'a');
    --i;
  }
  return result;
}

// Whether leaving the parameter out shows in the image.
bool changes_image(const Property& property) {
  if (property.name == "exposure") return number_of(property) != 0;
  if (property.name == "tonemap_method") return text_of(property) == "reinhard";
  if (property.name == "strict_normals") return std::get_if<bool>(&property.value) && std::get<bool>(property.value);
  return property.name == "max_smooth_angle";
}

}  // namespace

std::string MitsubaUpgrade::element(const XmlDocument& document, pugi::xml_node element) {
  const std::string_view name = element.name();
  if (!version.is_old()) return std::string(name);
  if (version.is_before(3) && name == "lookAt" && element.attribute("ox")) {
    note(document.location(element), "<lookAt> of numbers is <scale x=\"-1\"/> and <lookat>");
    return std::string(kLookatOfNumbers);
  }
  for (const ElementRule& rule : kElements) {
    if (rule.from != name || !applies(rule.before, version)) continue;
    note(document.location(element), fmt::format("<{}> is <{}>", name, rule.to));
    return std::string(rule.to);
  }
  return std::string(name);
}

std::string MitsubaUpgrade::parameter(const Literal& name) {
  if (!version.is_old()) return name.text;
  std::string today = snake_case(name.text);
  if (today != name.text) note(name.location(), fmt::format("{} is {}", quoted(name.text), quoted(today)));
  return today;
}

void MitsubaUpgrade::add(std::shared_ptr<Node> node) {
  if (!version.is_old()) return;
  const Node* const key = node.get();
  order_.push_back(key);
  old_nodes_.emplace(key, OldNode{std::move(node), version});
}

void MitsubaUpgrade::finish(Node& scene) {
  for (const Node* node : order_) upgrade_with_children(node);
  std::erase_if(scene.children, [this](const Node::Child& child) { return taken_apart_.contains(child.node.get()); });
}

// Children come before their parents, who may take them apart. References lead to few levels (see `References`).
void MitsubaUpgrade::upgrade_with_children(const Node* node) {
  const auto found = old_nodes_.find(node);
  if (found == old_nodes_.end()) return;
  const OldNode old = std::move(found->second);
  old_nodes_.erase(found);
  for (const Node::Child& child : old.node->children) upgrade_with_children(child.node.get());
  upgrade(*old.node, old.version);
}

std::vector<SceneChange> MitsubaUpgrade::take_changes() {
  const auto place = [](const SceneChange& change) {
    return std::tie(change.location.file, change.location.line, change.location.column);
  };
  std::ranges::stable_sort(changes_, {}, place);
  if (left_out_ > 0) changes_.push_back({{}, fmt::format("{} more changes", left_out_)});
  return std::move(changes_);
}

void MitsubaUpgrade::note(const SourceLocation& location, std::string text) {
  if (changes_.size() == kMaxChanges) {
    ++left_out_;
  } else {
    changes_.push_back({location, std::move(text)});
  }
}

void MitsubaUpgrade::warn(const SourceLocation& location, std::string text) {
  diagnostics_.warning(location, text);
  note(location, std::move(text));
}

void MitsubaUpgrade::upgrade(Node& node, SceneVersion of) {
  rename_parameters(node, of);
  leave_out_parameters(node);
  if (node.kind == "film") upgrade_film(node, of);
  if (node.kind == "integrator") upgrade_integrator(node);
  rename_plugin(node, of);
  if (node.kind == "bsdf") upgrade_bsdf(node, of);
  if (node.kind == "texture") upgrade_texture(node);
  if (node.kind == "sensor") upgrade_sensor(node, of);
  if (node.kind == "emitter") upgrade_emitter(node);
  if (node.kind == "shape") upgrade_shape(node, of);
}

void MitsubaUpgrade::rename_parameters(Node& node, SceneVersion of) {
  for (const ParameterRule& rule : kParameters) {
    if (!applies(rule.before, of) || rule.kind != node.kind || !is_among(node.plugin, rule.plugins)) continue;
    const auto renamed = [&](std::string& name, const SourceLocation& location) {
      if (name != rule.from || has(node, rule.to)) return false;
      note(location, fmt::format("{} is {}", quoted(name), quoted(rule.to)));
      name = rule.to;
      return true;
    };
    for (Property& property : node.properties) {
      const std::string before = property.name;
      if (renamed(property.name, property.name_location) && property.written.empty()) property.written = before;
    }
    for (Node::Child& child : node.children) renamed(child.name, child.location);
    for (std::string& name : node.unreadable) renamed(name, node.location);
  }
}

void MitsubaUpgrade::leave_out_parameters(Node& node) {
  const auto rule_for = [&node](std::string_view name) {
    return std::ranges::find_if(kLeftOut, [&](const LeftOutRule& rule) {
      return rule.kind == node.kind && is_among(node.plugin, rule.plugins) && is_among(name, rule.names);
    });
  };
  std::erase_if(node.properties, [&](const Property& property) {
    const auto* rule = rule_for(property.name);
    if (rule == std::end(kLeftOut)) return false;
    const std::string text = fmt::format("{} is left out: {}", quoted(property.file_name()), rule->why);
    changes_image(property) ? warn(property.location, text) : note(property.location, text);
    return true;
  });
  std::erase_if(node.unreadable, [&](const std::string& name) { return rule_for(name) != std::end(kLeftOut); });
}

void MitsubaUpgrade::rename_plugin(Node& node, SceneVersion of) {
  for (const PluginRule& rule : kPlugins) {
    if (!applies(rule.before, of) || rule.kind != node.kind || !is_among(node.plugin, rule.from)) continue;
    std::string text = fmt::format("{} {} is {}", node.kind, quoted(node.plugin), quoted(rule.to));
    if (!rule.why.empty()) text += fmt::format(", {}", rule.why);
    rule.why.empty() ? note(node.plugin_location, text) : warn(node.plugin_location, text);
    if (rule.keeps != "*") {
      std::erase_if(node.properties, [&](const Property& property) {
        if (is_among(property.name, rule.keeps)) return false;
        note(property.name_location, fmt::format("{} is left out: it is of {} {}", quoted(property.file_name()),
                                                 node.kind, quoted(node.plugin)));
        return true;
      });
      std::erase_if(node.unreadable, [&](const std::string& name) { return !is_among(name, rule.keeps); });
    }
    node.plugin = rule.to;
  }
}

void MitsubaUpgrade::upgrade_film(Node& node, SceneVersion of) {
  std::erase_if(node.properties, [&](const Property& property) {
    if (!property.name.starts_with("label[") && !property.name.starts_with("metadata[")) return false;
    note(property.name_location,
         fmt::format("{} is left out: such texts are not written into images", quoted(property.file_name())));
    return true;
  });
  if (node.plugin == "mfilm") {
    for (const char* name : {"width", "height"}) {
      if (!has(node, name)) add_property(node, name, "integer", std::int64_t{1});
    }
  }
  for (Property& property : node.properties) {
    if (of.is_before(4) && property.name == "alpha" && std::get_if<bool>(&property.value)) {
      property.value = std::string(std::get<bool>(property.value) ? "rgba" : "rgb");
      property.type = "string", property.written = "alpha", property.name = "pixel_format";
      note(property.name_location, fmt::format("'alpha' is 'pixel_format' {}", text_of(property)));
    } else if (property.name == "pixel_format" && std::get_if<std::string>(&property.value)) {
      // Of several, as for 'multichannel', the first is the image's.
      const std::string formats = text_of(property);
      property.value = snake_case(trim(std::string_view(formats).substr(0, formats.find(','))));
    }
  }
}

void MitsubaUpgrade::upgrade_integrator(Node& node) {
  if (node.plugin == "vpl" && !has(node, "max_depth")) add_property(node, "max_depth", "integer", std::int64_t{5});
  if (node.plugin == "multichannel") upgrade_multichannel(node);
  if (!is_among(node.plugin, "adaptive errctrl irrcache multichannel")) return;
  const auto inner = children_of_kind(node, "integrator");
  if (inner.size() != 1) return;
  warn(node.plugin_location, fmt::format("integrator {} is the {} inside of it", quoted(node.plugin),
                                         quoted(node.children[inner[0]].node->plugin)));
  become(node, *node.children[inner[0]].node);
}

// Fields become layers beside the image of the first of the others. Without fields nothing is done here.
void MitsubaUpgrade::upgrade_multichannel(Node& node) {
  std::vector<Node::Child> images;
  std::string aovs;
  for (const std::size_t place : children_of_kind(node, "integrator")) {
    const Node::Child& child = node.children[place];
    if (child.node->plugin != "field") {
      images.push_back(child);
      continue;
    }
    const Property* field = find(*child.node, "field");
    const std::string asked = field ? text_of(*field) : std::string();
    const auto* rule = std::ranges::find(kFields, asked, &FieldRule::from);
    if (rule == std::end(kFields)) {
      warn(child.node->plugin_location, fmt::format("the field {} is left out: there is no such layer", quoted(asked)));
    } else if (aovs.find(rule->to) == std::string::npos) {
      aovs += fmt::format("{}{}:{}", aovs.empty() ? "" : ",", rule->to, rule->to);
    }
  }
  for (std::size_t i = 1; i < images.size(); ++i)
    warn(images[i].location,
         fmt::format("integrator {} is left out: the image is that of the first one", quoted(images[i].node->plugin)));
  images.resize(std::min<std::size_t>(images.size(), 1));
  std::erase_if(node.children, [&](const Node::Child& child) {
    return child.node && child.node->kind == "integrator" && (images.empty() || child.node != images[0].node);
  });
  if (aovs.empty()) return;
  warn(node.plugin_location, "integrator 'multichannel' is 'aov': its fields are layers beside the image");
  node.plugin = "aov";
  node.properties.clear();
  add_property(node, "aovs", "string", aovs);
}

void MitsubaUpgrade::upgrade_sensor(Node& node, SceneVersion of) {
  if (!of.is_before(4)) return;
  // 0.4 turned the camera's x axis round, and the side that 'fov' spans had a switch.
  for (Property& property : node.properties) {
    auto* matrix = std::get_if<Property::Transform>(&property.value);
    if (property.name != "to_world" || !matrix) continue;
    *matrix = to_transform(to_glm(*matrix) * glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)));
    note(property.name_location, fmt::format("{} begins with <scale x=\"-1\"/>", quoted(property.file_name())));
  }
  if (node.plugin != "perspective") return;
  std::string axis = "smaller";
  std::erase_if(node.properties, [&](const Property& property) {
    if (property.name != "map_smaller_side" || !std::get_if<bool>(&property.value)) return false;
    if (!std::get<bool>(property.value)) axis = "larger";
    return true;
  });
  if (has(node, "fov_axis")) return;
  add_property(node, "fov_axis", "string", axis);
  note(node.location, fmt::format("'fov' spans the {} side: 'fov_axis' is '{}'", axis, axis));
}

void MitsubaUpgrade::upgrade_emitter(Node& node) {
  for (const Property& property : node.properties) {
    const auto* spectrum = std::get_if<Property::Spectrum>(&property.value);
    if (property.type != "spectrum" || !spectrum || spectrum->samples.size() != 1 || told_of_white_) continue;
    told_of_white_ = true;
    warn(property.location,
         fmt::format("{} of one value is light of equal energy at all wavelengths, a little red, as in Mitsuba 3; in "
                     "Mitsuba 0.6 it was daylight, which is <rgb>",
                     quoted(property.file_name())));
  }
}

void MitsubaUpgrade::upgrade_shape(Node& node, SceneVersion of) {
  if (of.is_before(3) && node.plugin == "obj" && !has(node, "flip_tex_coords")) {
    add_property(node, "flip_tex_coords", "boolean", false);
    note(node.location, "'flip_tex_coords' is false, as v was not turned before 0.3");
  }
  const bool has_light = !children_of_kind(node, "emitter").empty();
  if (of.is_before(3) && has_light && children_of_kind(node, "bsdf").empty()) {
    auto diffuse = std::make_shared<Node>();
    diffuse->kind = "bsdf", diffuse->plugin = "diffuse";
    diffuse->location = diffuse->plugin_location = node.location;
    node.children.push_back({{}, std::move(diffuse), node.location});
    note(node.location, "the light's surface is 'diffuse', as it was before 0.3");
  }
  const bool has_material = !children_of_kind(node, "bsdf").empty() || !children_of_kind(node, "emitter").empty();
  if (node.plugin != "obj" || has_material || told_of_materials_) return;
  told_of_materials_ = true;
  warn(node.plugin_location,
       "a shape 'obj' without a bsdf is grey; Mitsuba 0.6 takes the materials of the .mtl file that it may name");
}

}  // namespace norrsken
