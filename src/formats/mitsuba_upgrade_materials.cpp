// The part of the upgrade of old scenes that is about BSDFs.
#include <fmt/format.h>

#include <cmath>

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
  if (of.is_before(3) && node.plugin == "roughplastic") upgrade_microfacet(node);
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
    taken_apart_.insert(child.node.get());
    child.node = std::shared_ptr<const Node>(child.node->children[inside[0]].node);
  }
}

// How much of both reflectances there was told two factors.
void MitsubaUpgrade::upgrade_microfacet(Node& node) {
  struct Part {
    const char *reflectance, *amount;
    double by_default;
  };
  for (const Part& part :
       {Part{"diffuse_reflectance", "diffuse_amount", 0}, {"specular_reflectance", "specular_amount", 1}}) {
    const Property* given = find(node, part.amount);
    const double amount = given ? number_of(*given) : 1;
    const auto reflectance = std::ranges::find(node.properties, part.reflectance, &Property::name);
    if (reflectance != node.properties.end()) {
      multiply(*reflectance, amount);
    } else if (!has(node, part.reflectance)) {
      add_property(node, part.reflectance, "float", part.by_default * amount);
    } else if (amount != 1) {
      diagnostics_.error(given->location,
                         fmt::format("{} multiplies a texture, which is not supported", quoted(given->file_name())),
                         "1");
    }
    if (given)
      note(given->location, fmt::format("{} is a part of {}", quoted(given->file_name()), quoted(part.reflectance)));
    remove(node, part.amount);
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

}  // namespace norrsken
