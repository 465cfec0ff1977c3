// The part of the upgrade of old scenes that is about BSDFs and textures.
#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/mitsuba_upgrade.h"
#include "formats/mitsuba_upgrade_node.h"

namespace norrsken {
namespace {

using namespace upgrade;

// The numbers in a string; empty if it is not made of numbers.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> values;
  for (const TextPiece& piece : split(text, " \t\r\n,;")) {
    if (parse_number(piece.text, values.emplace_back()) != NumberStatus::ok) return {};
  }
  return values;
}

std::shared_ptr<Node> make_bsdf(const Node& like, std::string plugin) {
  auto node = std::make_shared<Node>();
  node->kind = "bsdf";
  node->plugin = std::move(plugin);
  node->location = like.location;
  node->plugin_location = like.plugin_location;
  return node;
}

// One of `bsdfs` from `first` on, with chances in proportion to `weights`.
std::shared_ptr<const Node> blend(const Node& mixture, const std::vector<Node::Child>& bsdfs,
                                  const std::vector<double>& weights, std::size_t first) {
  if (first + 1 == bsdfs.size()) return bsdfs[first].node;
  double rest = 0;
  for (std::size_t i = first + 1; i < weights.size(); ++i) rest += weights[i];
  const double sum = weights[first] + rest;
  auto node = make_bsdf(mixture, "blendbsdf");
  add_property(*node, "weight", "float", sum > 0 ? rest / sum : 0);
  node->children = {bsdfs[first], {{}, blend(mixture, bsdfs, weights, first + 1), mixture.location}};
  return node;
}

}  // namespace

void MitsubaUpgrade::upgrade_bsdf(Node& node, SceneVersion of) {
  if (of.is_before(3) && node.plugin == "mirror") {
    node.plugin = "conductor";
    add_property(node, "material", "string", std::string("Cr"));
    note(node.plugin_location, "bsdf 'mirror' is a 'conductor' of chrome");
  }
  if (is_among(node.plugin, "conductor roughconductor")) upgrade_conductor(node);
  if (node.plugin == "mixturebsdf") upgrade_mixture(node);
  if (node.plugin == "normalmap") {
    for (Node::Child& child : node.children) {
      if (!child.node || child.node->kind != "texture" || !child.name.empty()) continue;
      child.name = "normalmap";
      note(child.location, "the texture is named 'normalmap'");
    }
  }
  if (node.plugin != "bumpmap" || has(node, "scale")) return;
  // Heights were scaled by a texture around them.
  for (Node::Child& child : node.children) {
    if (!child.node || child.node->kind != "texture" || child.node->plugin != "scale") continue;
    const Property* scale = find(*child.node, "scale");
    const auto inside = children_of_kind(*child.node, "texture");
    if (inside.size() != 1 || child.node->properties.size() != (scale ? 1 : 0)) continue;
    if (scale && !std::get_if<double>(&scale->value) && !std::get_if<std::int64_t>(&scale->value)) continue;
    if (scale) node.properties.push_back(*scale);
    note(child.location, "the texture 'scale' is the parameter 'scale' of the bump map");
    child.node = std::shared_ptr<const Node>(child.node->children[inside[0]].node);
  }
}

void MitsubaUpgrade::upgrade_conductor(Node& node) {
  if (const Property* outside = find(node, "ext_eta")) {
    const std::string name = text_of(*outside);
    const bool is_number = !std::get_if<std::string>(&outside->value);
    if (equal_ignoring_case(name, "air") || equal_ignoring_case(name, "vacuum") ||
        (is_number && std::abs(number_of(*outside) - 1) < 0.001)) {
      note(outside->location, fmt::format("{} is left out: it is air", quoted(outside->file_name())));
      remove(node, "ext_eta");
    }
  }
  const bool eta = has(node, "eta"), k = has(node, "k");
  if (has(node, "material")) return;
  if (!eta && !k) {
    add_property(node, "material", "string", std::string("Cu"));
    warn(node.plugin_location, fmt::format("a {} without a material is of copper, as in Mitsuba 0.6; in Mitsuba 3 it "
                                           "reflects everything",
                                           quoted(node.plugin)));
  } else if (eta != k) {
    diagnostics_.error(node.plugin_location,
                       fmt::format("{} has '{}' alone, and copper's '{}' in Mitsuba 0.6", quoted(node.plugin),
                                   eta ? "eta" : "k", eta ? "k" : "eta"),
                       "both of eta and k, or neither");
  }
}

void MitsubaUpgrade::upgrade_mixture(Node& node) {
  const Property* given = find(node, "weights");
  std::vector<double> weights = given ? numbers_in(text_of(*given)) : std::vector<double>{};
  std::vector<Node::Child> bsdfs;
  for (const std::size_t place : children_of_kind(node, "bsdf")) bsdfs.push_back(node.children[place]);
  double sum = 0;
  for (const double weight : weights) sum += weight;
  const bool negative = std::ranges::any_of(weights, [](double weight) { return weight < 0; });
  if (bsdfs.empty() || weights.size() != bsdfs.size() || negative || !std::isfinite(sum)) {
    diagnostics_.error(given ? given->location : node.plugin_location,
                       fmt::format("{} weights for {} bsdfs of a 'mixturebsdf'", weights.size(), bsdfs.size()),
                       "'weights', a string of numbers from 0, one for each bsdf");
    bsdfs.assign(1, {{}, make_bsdf(node, "null"), node.location});  // not looked at: there was an error
    weights.assign(1, 1.0);
  } else if (sum < 1) {
    // What is missing is absorbed.
    auto black = make_bsdf(node, "diffuse");
    add_property(*black, "reflectance", "float", 0.0);
    bsdfs.push_back({{}, std::move(black), node.location});
    weights.push_back(1 - sum);
  }
  note(node.plugin_location,
       fmt::format("'mixturebsdf' is made of {}", bsdfs.size() == 2 ? "a 'blendbsdf'" : "'blendbsdf's"));
  become(node, *blend(node, bsdfs, weights, 0));
}

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
  if (u && v && text_of(*u) == text_of(*v) && !has(node, "wrap_mode")) {
    note(u->name_location, "'wrapModeU' and 'wrapModeV' are 'wrap_mode'");
    Property both = *u;
    both.name = "wrap_mode";
    remove(node, "wrap_mode_u");
    remove(node, "wrap_mode_v");
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

// A constant is multiplied out, and a factor of 1 vanishes; other factors are left, and complained about.
void MitsubaUpgrade::upgrade_scale_texture(Node& node) {
  const Property* factor = find(node, "scale");
  if (factor && !std::get_if<double>(&factor->value) && !std::get_if<std::int64_t>(&factor->value)) return;
  const double scale = factor ? number_of(*factor) : 1;
  const auto inside = children_of_kind(node, "texture");
  if (inside.size() == 1 && scale == 1) {
    note(node.plugin_location, "texture 'scale' by 1 is what is inside of it");
    become(node, *node.children[inside[0]].node);
    return;
  }
  const Property* value = find(node, "value");
  if (!value) return;
  Property constant = *value;
  if (auto* rgb = std::get_if<Property::Rgb>(&constant.value)) {
    for (double& component : rgb->value) component *= scale;
  } else if (auto* spectrum = std::get_if<Property::Spectrum>(&constant.value)) {
    for (auto& sample : spectrum->samples) sample.second *= scale;
  } else {
    constant.value = scale * number_of(constant);
  }
  note(node.plugin_location, "texture 'scale' of a constant is multiplied out");
  node.plugin = "rawconstant";
  remove(node, "scale");
  remove(node, "value");
  node.properties.push_back(std::move(constant));
}

}  // namespace norrsken
