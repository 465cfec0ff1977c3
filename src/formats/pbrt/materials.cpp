#include "formats/pbrt/materials.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "base/text.h"

namespace norrsken::pbrt {
namespace {

const std::vector<std::string> kTypes = {"coatedconductor",     "coateddiffuse", "conductor", "dielectric", "diffuse",
                                         "diffusetransmission", "hair",          "interface", "measured",   "mix",
                                         "subsurface",          "thindielectric"};

bool is_interface_type(std::string_view type) { return type == "interface" || type == "none" || type.empty(); }

/// Both sides scatter, in pbrt.
Node two_sided(Node front, const Place& place) {
  Node node = make_node("bsdf", "twosided", place);
  node.add(std::move(front));
  return node;
}

}  // namespace

Materials::Materials(Context& context, Textures& textures) : context_(context), textures_(textures) {
  add("diffuse", Parameters("material 'diffuse'", {}, {}, context.diagnostics), srgb_space());
}

std::size_t Materials::add(std::string type, Parameters parameters, const ColorSpace& space) {
  context_.memory.grow(sizeof(Definition));
  definitions_.push_back({std::move(type), std::move(parameters), &space});
  return definitions_.size() - 1;
}

bool Materials::add_named(const std::string& name, std::string type, Parameters parameters, const ColorSpace& space) {
  if (names_.contains(name)) return false;
  names_[name] = add(std::move(type), std::move(parameters), space);
  return true;
}

const Materials::Definition* Materials::find(const MaterialUse& use) const {
  if (use.name.empty()) return &definitions_[use.number];
  const auto named = names_.find(use.name);
  return named == names_.end() ? nullptr : &definitions_[named->second];
}

bool Materials::is_interface(const MaterialUse& use) const {
  const Definition* definition = find(use);
  return definition && is_interface_type(definition->type);
}

bool Materials::depends_on_uv(const MaterialUse& use) const {
  const Definition* definition = find(use);
  return !definition || definition->type == "mix" || definition->parameters.depends_on_uv();
}

std::shared_ptr<const Node> Materials::node(const MaterialUse& use) {
  auto* definition = const_cast<Definition*>(find(use));
  if (definition) return read(*definition);
  std::vector<std::string> known;
  for (const auto& [name, number] : names_) known.push_back(name);
  context_.diagnostics.error(use.place.location(),
                             fmt::format("there is no material {}{}", quoted(use.name), did_you_mean(use.name, known)),
                             known.empty() ? "one that MakeNamedMaterial makes" : listed(known));
  return nullptr;
}

void Materials::finish() {
  for (Definition& definition : definitions_) {
    read(definition);
    definition.parameters.finish();
  }
}

std::shared_ptr<const Node> Materials::read(Definition& definition) {
  if (definition.node) return definition.node;
  if (definition.is_open) {
    definition.parameters.error(nullptr, "material 'mix' is made of itself", "materials declared before");
    return nullptr;
  }
  definition.is_open = true;
  Node node = with_relief(definition, make(definition));
  definition.node = std::make_shared<const Node>(std::move(node));
  definition.is_open = false;
  return definition.node;
}

Node Materials::make(Definition& definition) {
  const std::string& type = definition.type;
  Parameters& p = definition.parameters;
  if (is_interface_type(type)) return make_node("bsdf", "null", p.place());
  if (type == "mix") return make_mix(definition);
  if (type == "conductor") return two_sided(make_conductor(definition, {}), p.place());
  if (type == "coatedconductor") return two_sided(make_conductor(definition, "conductor."), p.place());
  if (type == "coateddiffuse") return two_sided(make_coated_diffuse(definition), p.place());
  if (type == "dielectric") return make_dielectric(definition);
  if (type == "diffusetransmission") return make_diffuse_transmission(definition);
  if (type == "subsurface") return two_sided(make_subsurface(definition), p.place());
  if (type == "hair") return make_hair(definition);
  if (type == "measured") return two_sided(make_measured(definition), p.place());
  if (type == "thindielectric") {
    Node node = make_node("bsdf", "thindielectric", p.place());
    give(node, "int_ior", read_index(context_, p, "eta", 1.5), p.place());
    give(node, "ext_ior", 1.0, p.place());
    return node;
  }
  if (type != "diffuse") {
    context_.diagnostics.error(p.place().location(),
                               fmt::format("unknown material {}{}", quoted(type), did_you_mean(type, kTypes)),
                               join(kTypes));
  }
  Node node = make_node("bsdf", "diffuse", p.place());
  give_color(context_, node, "reflectance",
             textures_.color(p, "reflectance", Slot::albedo, *definition.space, glm::dvec3(0.5)), p.place());
  return two_sided(std::move(node), p.place());
}

Node Materials::with_relief(Definition& definition, Node inside) {
  Parameters& p = definition.parameters;
  if (is_interface_type(definition.type) || definition.type == "mix" || definition.type == "hair") return inside;
  const Parameter* displacement = p.find("texture", "displacement");
  const Parameter* normals = p.find("string", "normalmap");
  if (displacement) {
    const Pattern heights = textures_.number(p, "displacement", 0);
    if (heights.is_constant) return inside;
    Node node = make_node("bsdf", "bumpmap", displacement->place);
    add_child(node, texture_node(context_, heights, displacement->place, /*grey=*/true), "texture",
              displacement->place);
    node.add(std::move(inside));
    return node;
  }
  if (!normals || !p.has_values(*normals, 1)) return inside;
  Node image = make_node("texture", "bitmap", normals->place);
  give(image, "filename", normals->strings[0], normals->value);
  give(image, "raw", true, normals->place);
  Property::Transform upside_down;
  upside_down.rows[1][1] = -1, upside_down.rows[1][3] = 1;
  give(image, "to_uv", upside_down, normals->place);
  Node node = make_node("bsdf", "normalmap", normals->place);
  add_child(node, std::make_shared<const Node>(std::move(image)), "normalmap", normals->place);
  node.add(std::move(inside));
  return node;
}

Node Materials::make_mix(Definition& definition) {
  Parameters& p = definition.parameters;
  const Parameter* materials = p.find("string", "materials");
  Node node = make_node("bsdf", "blendbsdf", p.place());
  give_number(context_, node, "weight", textures_.number(p, "amount", 0.5), p.place());
  if (!materials || !p.has_values(*materials, 2)) {
    if (!materials) p.error(nullptr, "material 'mix' has no materials", R"("string materials" [ "a" "b" ])");
    return node;
  }
  for (const std::string& name : materials->strings) {
    const MaterialUse use{.name = name, .place = materials->value};
    if (is_interface(use)) {
      p.error(materials, fmt::format("material 'mix' cannot have {}, an interface", quoted(name)), "other materials");
      continue;
    }
    if (const auto part = this->node(use)) add_child(node, part, {}, materials->place);
  }
  return node;
}

}  // namespace norrsken::pbrt
