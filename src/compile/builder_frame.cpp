// The builder's part that is about frames: integrator, sensor, film, sampler, reconstruction filter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/text.h"
#include "compile/builder.h"
#include "compile/crop_window.h"
#include "compile/default_sensor.h"
#include "compile/plugins.h"
#include "compile/scene_children.h"
#include "scene/within_memory.h"
#include "tables/film_memory.h"

namespace norrsken {
namespace {

/// Integrators within integrators.
constexpr int kMaxIntegratorDepth = 8;

/// Of which a sensor has one or the other.
constexpr std::pair<std::string_view, std::string_view> kExclusive[] = {{"fov", "focal_length"}};

/// Whether it has a picture of what lies before it, so that a path from elsewhere can be connected to it.
bool is_camera(CameraKind kind) {
  switch (kind) {
#define NORRSKEN_CAMERA(name, Model) case CameraKind::name:
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
    return true;
    default:
      return false;
  }
}

void remove_property(std::string_view name, Node& node) {
  std::erase_if(node.properties, [name](const Property& known) { return known.name == name; });
}

void replace_property(const Property& property, Node& node) {
  remove_property(property.name, node);
  for (const auto& [one, other] : kExclusive) {
    if (property.name == one) remove_property(other, node);
    if (property.name == other) remove_property(one, node);
  }
  node.properties.push_back(property);
}

/// What a sensor does not have of its own, it has of the one that it stands in for.
void take_film_and_sampler(const Node& from, Node& to) {
  for (const char* kind : {"film", "sampler"}) {
    const auto is_kind = [kind](const Node::Child& child) { return child.node->kind == kind; };
    if (std::ranges::none_of(to.children, is_kind))
      std::ranges::copy_if(from.children, std::back_inserter(to.children), is_kind);
  }
}

}  // namespace

/// Calls the node's plugin. What of the node it does not ask for is an error, unless `tolerates` it.
template <class Function, class... Tools>
auto Builder::compile_node(const Node& node, std::span<const Plugin<Function>> table, bool tolerates,
                           Tools&&... tools) {
  decltype(table[0].compile(std::declval<Parameters&>(), tools...)) settings;
  if (const auto* plugin = find_plugin(table, node, diagnostics_)) {
    Parameters p = parameters(node);
    settings = plugin->compile(p, tools...);
    if (!tolerates) p.finish();
    describe(node, {});
  }
  return settings;
}

IntegratorSettings Builder::integrator(const Node& node) {
  IntegratorSettings settings;
  if (integrator_depth_ == kMaxIntegratorDepth) {
    diagnostics_.error(node.location, fmt::format("integrators are nested more than {} deep", kMaxIntegratorDepth),
                       fmt::format("up to {} inside each other", kMaxIntegratorDepth));
  } else {
    ++integrator_depth_;
    settings = compile_node(node, integrator_plugins(), /*tolerates=*/false, Integrators(*this));
    --integrator_depth_;
  }
  return settings;
}

FilterRecord Builder::rfilter(Parameters& film) {
  Node default_filter("rfilter", "gaussian");
  default_filter.location = film.node().location;
  const Node::Child* child = film.child("rfilter");
  return compile_node(child ? *child->node : default_filter, rfilter_plugins(), /*tolerates=*/false, tables().filter);
}

/// Compiles `child`, or the plugin `fallback` if there is none. A plugin that replaces another takes the node's parameters,
/// except for those it does not know.
template <class Function, class... Tools>
auto Builder::compile_chosen(const Node::Child* child, const char* kind, const char* fallback,
                             const Replacement& replacement, std::span<const Plugin<Function>> table,
                             std::string& plugin_name, Tools&&... tools) {
  Node node;
  if (replacement.node) {
    node = *replacement.node;
  } else if (child) {
    node = *child->node;
  } else {
    node.kind = kind;
    node.plugin = fallback;
  }
  const bool replaced = replacement.plugin && *replacement.plugin != node.plugin;
  if (replaced) {
    node.plugin = *replacement.plugin;
    node.plugin_location = {};
  }
  plugin_name = node.plugin;
  return compile_node(node, table, /*tolerates=*/replaced, std::forward<Tools>(tools)...);
}

FilmSettings Builder::film(Parameters& sensor, const ViewOptions& view, SourceLocation& place) {
  FilmSettings settings;
  Node default_film("film", "hdrfilm");
  default_film.location = sensor.node().location;
  const Node::Child* child = sensor.child("film");
  const Node& node = child ? *child->node : default_film;
  const auto* plugin = find_plugin(film_plugins(), node, diagnostics_);
  if (!plugin) return settings;
  Parameters p = parameters(node);
  Films films(*this);
  settings = plugin->compile(p, films);
  p.finish();

  // Another size shows the same picture, and a crop window the same part of it.
  const auto override_side = [&](const char* name, const std::optional<int>& value, int& full, int& offset, int& size) {
    if (!value) return;
    const int side = std::clamp(*value, 1, kMaxFilmSide);
    if (side != *value) {
      diagnostics_.error({}, fmt::format("{} {} is out of range", name, *value), fmt::format("1 to {}", kMaxFilmSide));
    }
    scale_window(offset, size, full, side);
    full = side;
  };
  override_side("width", view.width, settings.full_width, settings.crop_x, settings.width);
  override_side("height", view.height, settings.full_height, settings.crop_y, settings.height);
  if (view.crop) {
    const auto [x, y, width, height] = *view.crop;
    if (x < 0 || y < 0 || width < 1 || height < 1 || x > settings.full_width - width ||
        y > settings.full_height - height) {
      diagnostics_.error({}, fmt::format("a crop of {} x {} at ({}, {})", width, height, x, y),
                         fmt::format("a part of {} x {} pixels", settings.full_width, settings.full_height));
    } else {
      settings.crop_x = x, settings.crop_y = y, settings.width = width, settings.height = height;
    }
  }
  const auto pixels = static_cast<std::uint64_t>(std::int64_t{settings.width} * settings.height);
  place = view.width || view.height || view.crop ? SourceLocation{} : node.location;
  if (pixels > kMaxFilmPixels) {
    diagnostics_.error(place, fmt::format("a film of {} x {} has {} pixels", settings.width, settings.height, pixels),
                       fmt::format("up to {} pixels", kMaxFilmPixels));
  }
  std::string detail = fmt::format("{} x {}", settings.width, settings.height);
  if (settings.width != settings.full_width || settings.height != settings.full_height) {
    detail += fmt::format(" at ({}, {}) of {} x {}", settings.crop_x, settings.crop_y, settings.full_width,
                          settings.full_height);
  }
  describe(node, std::move(detail));
  return settings;
}

void Builder::measure_film(const SourceLocation& place, bool reserve) {
  const FilmSettings& settings = tables().film;
  SceneInfo::Memory& memory = scene_.info.memory;
  const std::uint64_t film_bytes = film_bytes_per_pixel(settings, tables().sampler.kind, scene_.layers,
                                                        tables().integrator.from_lights),
                      image_bytes = image_bytes_per_pixel(settings, scene_.layers);
  const auto pixels = static_cast<std::uint64_t>(std::int64_t{settings.width} * settings.height);
  memory.film = pixels * film_bytes, memory.image = pixels * image_bytes;
  if (!reserve) return;
  try {
    film_memory_ = MemoryReservation(memory.film + memory.image);
  } catch (const MemoryExceeded& e) {
    const std::uint64_t left = e.limit - std::min(e.used, e.limit);
    diagnostics_.error(
        place,
        shortage_text(
            fmt::format("a film of {} x {} pixels with its image needs", settings.width, settings.height).c_str(),
            e.wanted, left, e.limit),
        fmt::format("up to {} pixels, as by a smaller --size, or a larger --max-memory",
                    left / (film_bytes + image_bytes)));
    throw LoadingStopped{};
  }
}

void Builder::compile_sampler(Parameters& sensor, const ViewOptions& view) {
  tables().sampler = compile_chosen(sensor.child("sampler"), "sampler", "sobol", {view.sampler, view.sampler_node},
                                    sampler_plugins(), scene_.info.sampler);
  if (!view.samples_per_pixel) return;
  if (*view.samples_per_pixel < 1) {
    diagnostics_.error({}, fmt::format("{} samples per pixel", *view.samples_per_pixel),
                       fmt::format("an integer from 1 to {}", kMaxSampleCount));
    return;
  }
  tables().sampler.samples_per_pixel = *view.samples_per_pixel;
}

std::shared_ptr<const Node> Builder::sensor_node(Parameters& scene, const ViewOptions& view) {
  const auto sensors = scene.children("sensor");
  const Node* chosen = choose_sensor(scene, view.sensor, /*tell_of_others=*/!is_frame_alone_ && !view.sensor_node);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const bool is_chosen = sensors[i]->node.get() == chosen && !view.sensor_node;
    if (is_chosen) scene_.info.sensor = static_cast<int>(i), scene_.info.sensor_id = chosen->id;
    if (sensors.size() == 1) continue;
    describe(*sensors[i]->node,
             fmt::format("--sensor {}{}", word_for_sensor(sensors, i), is_chosen ? ", the one that is used" : ""));
  }
  if (!chosen && !view.sensor_node) {
    // What is missing because of an error is not in need of another one.
    if (!sensors.empty() || view.sensor || !is_whole_) return nullptr;
    if (scene.children("shape").empty() && scene.children("emitter").empty()) {
      diagnostics_.error(scene.node().location, "the scene has no sensor", "<sensor type=\"perspective\">");
      return nullptr;
    }
    default_sensor_ = make_default_sensor(scene.node().location);
    return std::make_shared<const Node>(*default_sensor_);
  }
  auto node = std::make_shared<Node>(view.sensor_node ? *view.sensor_node : *chosen);
  if (view.sensor_node && chosen) take_film_and_sampler(*chosen, *node);
  for (const Property& property : view.camera) replace_property(property, *node);
  return node;
}

void Builder::compile_sensor(Parameters& scene, const ViewOptions& view, bool reserve) {
  sensor_ = sensor_node(scene, view);
  if (!sensor_) return;
  const auto* plugin = find_plugin(sensor_plugins(), *sensor_, diagnostics_);
  if (!plugin) return;
  Parameters p = parameters(*sensor_);
  SourceLocation film_place;
  tables().film = film(p, view, film_place);
  compile_sampler(p, view);
  if (!diagnostics_.has_errors()) measure_film(film_place, reserve);
  if (!default_sensor_) compile_camera(p, plugin->compile);
}

void Builder::compile_camera(Parameters& sensor, CompileSensor* compile) {
  Sensors sensors(*this);
  tables().batch.clear();
  tables().meter.clear();
  tables().camera = compile(sensor, sensors, tables().film);
  tables().camera.medium = medium_around(sensor);
  if (tables().camera.medium != kNone) {
    for (CameraRecord& camera : tables().batch) camera.medium = tables().camera.medium;
  }
  if (tables().integrator.from_lights && !is_camera(tables().camera.kind)) {
    diagnostics_.error(sensor.node().plugin_location,
                       fmt::format("nothing that begins at the lights finds sensor {}, as paths of integrator {} would",
                                   quoted(sensor.node().plugin), quoted(scene_.info.integrator)),
                       "another integrator, or another sensor");
  }
  view_place_ = sensor.where("far_clip");
  refuse_kinds_to_come(sensor);
  sensor.finish();
}

CameraRecord Builder::sensor_inside(const Node& node, const FilmSettings& part) {
  const auto* plugin = find_plugin(sensor_plugins(), node, diagnostics_);
  if (!plugin) return {};
  Parameters p = parameters(node);
  Sensors sensors(*this);
  CameraRecord camera = plugin->compile(p, sensors, part);
  camera.medium = medium_around(p);
  for (const char* kind : {"film", "sampler"}) p.children(kind);
  refuse_kinds_to_come(p);
  p.finish();
  return camera;
}

void Builder::compile_default_camera() {
  if (!default_sensor_) return;
  const GeometryBuilder::Box bounds = geometry_.bounds();
  if (!bounds.empty()) look_at_box(*default_sensor_, bounds.lower, bounds.upper);
  Parameters p = parameters(*default_sensor_);
  for (const char* kind : {"film", "sampler"}) p.children(kind);
  compile_camera(p, find_plugin(sensor_plugins(), *default_sensor_, diagnostics_)->compile);
  const float* origin = tables().camera.origin;
  diagnostics_.note(default_sensor_->location,
                    fmt::format("the scene has no sensor: the picture is taken from ({:.4g}, {:.4g}, {:.4g}) along +z, "
                                "{:g} degrees wide",
                                origin[0], origin[1], origin[2], kDefaultFieldOfView),
                    "a <sensor> for another one");
}

void Builder::compile_frame(Parameters& scene, const std::set<const Node*>& inside, const ViewOptions& view,
                            bool reserve) {
  tables().integrator =
      compile_chosen(integrator_of_scene(scene, inside), "integrator", "path", {view.integrator, view.integrator_node},
                     integrator_plugins(), scene_.info.integrator, Integrators(*this));
  compile_sensor(scene, view, reserve);
  scene_.frame_items = scene_.info.items.size();
}

SceneFrame Builder::build_frame(const ViewOptions& view, const std::map<const Node*, std::uint32_t>& media) {
  scene_.media = media;
  is_frame_alone_ = true;
  Parameters p = parameters(*description_.scene);
  compile_frame(p, nodes_inside_of_others(*description_.scene), view, /*reserve=*/false);
  return scene_.frame(view);
}

}  // namespace norrsken
