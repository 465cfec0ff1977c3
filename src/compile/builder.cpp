#include "compile/builder.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <utility>

#include "base/text.h"
#include "compile/plugins.h"
#include "compile/scene_children.h"
#include "scene/constant_spectrum.h"
#include "scene/within_memory.h"
#include "tables/accel_memory.h"

namespace norrsken {
namespace {

/// Adapters within adapters: far more than any scene needs, far fewer than the stack holds.
constexpr int kMaxBsdfDepth = 64;
/// Textures within textures: kernels look them up one inside the other.
constexpr int kMaxTextureDepth = 8;

/// Sensors, which a scene without any has by then, and integrators.
Description outline_of(const Description& description, const std::optional<Node>& default_sensor) {
  auto root = std::make_shared<Node>();
  root->kind = description.scene->kind;
  root->location = description.scene->location;
  for (const Node::Child& child : description.scene->children) {
    if (child.node->kind == "sensor" || child.node->kind == "integrator") root->children.push_back(child);
  }
  if (default_sensor) root->add(*default_sensor);
  return {std::move(root), description.search_paths, description.parameters};
}

template <class Container>
std::uint64_t bytes_of(const Container& container) {
  return container.capacity() * sizeof(container[0]);
}

Variation variation_of(const Texture& texture) {
  return texture_kind(texture.word) == TextureKind::mesh_attribute ? Variation::by_triangle : Variation::over_uv;
}

}  // namespace

void Builder::refuse_kinds_to_come(Parameters& parameters) {
  for (const Node::Child& child : parameters.node().children) {
    const std::string& kind = child.node->kind;
    if (kind == "volume") {
      diagnostics_.error(
          child.location,
          fmt::format("a volume stands in {} {}", parameters.node().kind, quoted(parameters.node().plugin)),
          "a volume inside of a medium");
    } else if (kind == "texture") {
      complain_about_plugin(*child.node, {"rgb, spectrum or float"}, diagnostics_);
    } else {
      continue;
    }
    parameters.children(kind);  // said enough about those
  }
}

void Builder::describe(const Node& node, std::string detail) {
  if (is_silent_) return;
  scene_.info.items.push_back({node.kind, node.plugin, node.id, std::move(detail)});
}

Material Builder::bsdf(const Node& node) {
  if (const auto known = materials_.find(&node); known != materials_.end()) {
    vary(known->second.variation);
    return known->second;
  }
  Material material;
  const Variation around = std::exchange(variation_, Variation::none);
  if (bsdf_depth_ == kMaxBsdfDepth) {
    diagnostics_.error(node.location, fmt::format("bsdfs are nested more than {} deep", kMaxBsdfDepth),
                       fmt::format("up to {} inside each other", kMaxBsdfDepth));
  } else if (const auto* plugin = find_plugin(bsdf_plugins(), node, diagnostics_)) {
    ++bsdf_depth_;
    Parameters p = parameters(node);
    Materials materials(*this);
    material = plugin->compile(p, materials);
    p.finish();
    --bsdf_depth_;
    for (const Node::Child& child : node.children) {
      const auto inside = materials_.find(child.node.get());
      if (inside == materials_.end()) continue;
      material.choices = std::max(material.choices, inside->second.choices);
      material.maps = std::max(material.maps, inside->second.maps);
    }
    if (chooses_bsdf(node.plugin)) ++material.choices;
    if (perturbs_bsdf(node.plugin)) ++material.maps;
    tables().material_choices = std::max(tables().material_choices, material.choices);
  }
  material.variation = variation_;
  vary(around);
  materials_.emplace(&node, material);
  return material;
}

Texture Builder::texture(const Node& node) {
  if (const auto known = textures_.find(&node); known != textures_.end()) {
    vary(variation_of(known->second));
    return known->second;
  }
  Texture texture;
  if (const Node* inside = texture_in_daylight(node)) {
    Parameters p = parameters(node);
    read_daylight(p);
    p.finish();
    texture = this->texture(*inside);
  } else if (texture_depth_ == kMaxTextureDepth) {
    diagnostics_.error(node.location, fmt::format("textures are nested more than {} deep", kMaxTextureDepth),
                       fmt::format("up to {} inside each other", kMaxTextureDepth));
  } else if (const auto* plugin = find_plugin(texture_plugins(), node, diagnostics_)) {
    ++texture_depth_;
    Parameters p = parameters(node);
    Textures textures(*this);
    texture = plugin->compile(p, textures);
    p.finish();
    --texture_depth_;
  }
  textures_.emplace(&node, texture);
  vary(variation_of(texture));
  return texture;
}

TextureWord Builder::add_texture(TextureKind kind, std::span<const float> block) {
  need_uv();
  tables().texture_kinds |= 1u << static_cast<std::uint32_t>(kind);
  return make_texture(kind, add_parameters(block));
}

std::optional<Texture> Builder::texture_of(Parameters& p, std::string_view name, const Range& range) {
  const Node::Child* child = p.texture(name);
  if (!child) return std::nullopt;
  return within_range(p, name, texture(*child->node), range);
}

ColorOrTexture Builder::read(Parameters& p, const ColorParameter& color) {
  if (const auto texture = texture_of(p, color.name, color.range)) return {SceneColor(texture->mean), texture->word};
  return {p.read(color)};
}

NumberOrTexture Builder::read(Parameters& p, const NumberParameter& number) {
  if (const auto texture = texture_of(p, number.name, number.range))
    return {SceneColor(texture->mean).mean(), texture->number != 0 ? texture->number : texture->word};
  NumberParameter value = number;
  value.takes_colors = true;
  return {p.read(value)};
}

std::uint32_t Builder::add_parameters(std::span<const float> values) {
  auto& stored = tables().parameters;
  const auto offset = static_cast<std::uint32_t>(stored.size());
  stored.insert(stored.end(), values.begin(), values.end());
  if (stored.size() <= kMaterialOffsetMask) return offset;
  diagnostics_.error({}, "the scene has too many bsdfs, textures and lights",
                     fmt::format("{} parameters in all", kMaterialOffsetMask));
  stored.resize(offset);
  return 0;
}

MaterialWord Builder::add_material(BsdfKind kind, std::span<const float> block) {
  tables().bsdf_kinds |= 1u << static_cast<std::uint32_t>(kind);
  return make_material(kind, add_parameters(block));
}

std::uint32_t Builder::add_light(const LightRecord& light, const LightPower& power) {
  light_powers_.push_back(power);
  light_powers_.back().weight = sampling_weight_;
  tables().lights.push_back(light);
  return static_cast<std::uint32_t>(tables().lights.size() - 1);
}

void Builder::add_environment(const Node& node, const LightRecord& light, const LightPower& power) {
  if (tables().environment != kNone) {
    diagnostics_.error(node.location, "the scene has more than one environment",
                       "one emitter that surrounds the scene");
    return;
  }
  tables().environment = add_light(light, power);
}

void Builder::choose_lights() {
  if (!light_powers_.empty() && std::ranges::all_of(light_powers_, [](const LightPower& p) { return p.weight == 0; })) {
    diagnostics_.error(description_.scene->location, "every emitter has a sampling_weight of 0",
                       "a sampling_weight above 0 for one of them");
  }
  norrsken::choose_lights(tables(), light_powers_);
}

void Builder::summarise() {
  const SceneTables& t = tables();
  SceneInfo& info = scene_.info;
  info.parameters = description_.parameters;
  for (const SceneChange& change : description_.changes)
    info.changes.push_back((change.location.file.empty() ? "" : place_text(change.location) + ": ") + change.text);
  info.triangles = t.triangle_count();
  info.spheres = t.sphere_count();
  info.other_shapes = t.analytics.size();
  info.instances = t.instances.size();
  info.lights = t.lights.size();
  info.width = t.film.width;
  info.height = t.film.height;
  info.samples_per_pixel = static_cast<int>(t.sampler.samples_per_pixel);
  info.max_depth = t.integrator.max_depth;
  info.rr_depth = t.integrator.rr_depth;
  info.emitter_samples = t.integrator.emitter_samples;
  info.memory.geometry = bytes_of(t.positions) + bytes_of(t.normals) + bytes_of(t.texcoords) +
                         bytes_of(t.triangle_vertices) + bytes_of(t.surfaces) + bytes_of(t.shapes) +
                         bytes_of(t.analytics) + bytes_of(t.instances);
  info.memory.textures = bytes_of(t.texels);
  info.memory.other_tables = bytes_of(t.parameters) + bytes_of(t.lights) + bytes_of(t.primitive_lights) +
                             bytes_of(t.light_nodes) + bytes_of(t.light_leaves) + bytes_of(t.lights_around) +
                             bytes_of(t.filter) + bytes_of(t.media) + bytes_of(t.volumes);
  info.memory.acceleration = acceleration_bytes(t);
  if (const auto& budget = MemoryScope::current()) info.memory.loading = budget->peak();
}

LoadedScene Builder::build(const LoadOptions& options) {
  const Node& root = *description_.scene;
  is_whole_ = !diagnostics_.has_errors();
  const std::set<const Node*> inside = nodes_inside_of_others(root);
  Parameters p = parameters(root);
  compile_frame(p, inside, view_of(options), options.reserve_film);
  const std::set<const Node*> in_use = nodes_in_use(root);
  const auto for_each = [&](const char* kind, auto&& compile_it) {
    for (const Node::Child* child : p.children(kind)) {
      if (in_use.contains(child->node.get()) || is_supported(*child->node, diagnostics_)) compile_it(*child->node);
    }
  };
  for_each("bsdf", [&](const Node& node) { bsdf(node); });
  for (const char* kind : {"spectrum", "texture"}) {
    for_each(kind, [&](const Node& node) {
      if (!is_constant_spectrum(node)) texture(node);
    });
  }
  for_each("shape", [&](const Node& node) { compile_shape(node); });
  for (const Node* emitter : emitters_of_scene(p, inside)) compile_emitter(*emitter, kNone);
  for (const Node::Child* sensor : p.children("sensor")) {
    for (const Node::Child& child : sensor->node->children) {
      if (child.node->kind == "medium") medium(*child.node);
    }
  }
  take_definitions(p, inside);
  p.finish();
  compile_default_camera();
  if (!diagnostics_.has_errors()) {
    if (p.children("shape").empty()) diagnostics_.warning(root.location, "the scene has no shape");
    if (tables().lights.empty()) diagnostics_.warning(root.location, "the scene has no emitter: its image is black");
    tell_what_is_beyond_view();
  }
  geometry_.finish(scene_.info);
  attributes_.finish();
  choose_lights();
  summarise();
  scene_.memory = MemoryScope::current();
  scene_.file = root.location.file;
  scene_.outline = outline_of(description_, default_sensor_);
  scene_.view = view_of(options);
  return std::move(scene_);
}

}  // namespace norrsken
