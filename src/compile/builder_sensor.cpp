// The builder's part that is about what the picture is taken with: sensor, film and sampler.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compile/builder.h"
#include "compile/default_sensor.h"
#include "compile/plugins.h"
#include "compile/scene_children.h"
#include "scene/within_memory.h"
#include "tables/film_memory.h"

namespace norrsken {

FilmSettings Builder::film(Parameters& sensor, const LoadOptions& options, SourceLocation& place) {
  FilmSettings settings;
  Node default_film;
  default_film.kind = "film";
  default_film.plugin = "hdrfilm";
  default_film.location = sensor.node().location;
  const Node::Child* child = sensor.child("film");
  const Node& node = child ? *child->node : default_film;
  const auto* plugin = find_plugin(film_plugins(), node, diagnostics_);
  if (!plugin) return settings;
  Parameters p = parameters(node);
  settings = plugin->compile(p, *this);
  p.finish();

  // Another size shows the same picture, and a crop window the same part of it.
  const auto override_side = [&](const char* name, const std::optional<int>& value, int& full, int& offset, int& size) {
    if (!value) return;
    const int side = std::clamp(*value, 1, kMaxFilmSide);
    if (side != *value) {
      diagnostics_.error({}, fmt::format("{} {} is out of range", name, *value), fmt::format("1 to {}", kMaxFilmSide));
    }
    const auto scaled = [&](int x) { return static_cast<int>(std::lround(static_cast<double>(x) * side / full)); };
    const int begin = std::min(scaled(offset), side - 1), end = std::max(scaled(offset + size), begin + 1);
    full = side, offset = begin, size = end - begin;
  };
  override_side("width", options.width, settings.full_width, settings.crop_x, settings.width);
  override_side("height", options.height, settings.full_height, settings.crop_y, settings.height);
  const auto pixels = static_cast<std::uint64_t>(std::int64_t{settings.width} * settings.height);
  place = options.width || options.height ? SourceLocation{} : node.location;
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

void Builder::compile_sensor(Parameters& scene, const LoadOptions& options) {
  const auto sensors = scene.children("sensor");
  const Node* chosen = choose_sensor(scene, options.sensor);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const bool is_chosen = sensors[i]->node.get() == chosen;
    if (is_chosen) scene_.info.sensor = static_cast<int>(i), scene_.info.sensor_id = chosen->id;
    if (sensors.size() == 1) continue;
    describe(*sensors[i]->node,
             fmt::format("--sensor {}{}", word_for_sensor(sensors, i), is_chosen ? ", the one that is used" : ""));
  }
  // What is missing because of an error is not in need of another one.
  if (!chosen && (!sensors.empty() || options.sensor || !is_whole_)) return;
  if (!chosen && scene.children("shape").empty() && scene.children("emitter").empty()) {
    diagnostics_.error(scene.node().location, "the scene has no sensor", "<sensor type=\"perspective\">");
    return;
  }
  if (!chosen) chosen = &default_sensor_.emplace(make_default_sensor(scene.node().location));
  if (!find_plugin(sensor_plugins(), *chosen, diagnostics_)) return;
  Parameters p = parameters(*chosen);
  SourceLocation film_place;
  tables().film = film(p, options, film_place);
  compile_sampler(p, options);
  if (!diagnostics_.has_errors()) measure_film(film_place, options.reserve_film);
  if (!default_sensor_) compile_camera(p);
}

void Builder::compile_camera(Parameters& sensor) {
  const auto* plugin = find_plugin(sensor_plugins(), sensor.node(), diagnostics_);
  tables().camera = plugin->compile(sensor, *this, tables().film);
  view_place_ = sensor.where("far_clip");
  refuse_kinds_to_come(sensor);
  sensor.finish();
}

void Builder::compile_default_camera() {
  if (!default_sensor_) return;
  const GeometryBuilder::Box bounds = geometry_.bounds();
  if (!bounds.empty()) look_at_box(*default_sensor_, bounds.lower, bounds.upper);
  Parameters p = parameters(*default_sensor_);
  for (const char* kind : {"film", "sampler"}) p.children(kind);
  compile_camera(p);
  const float* origin = tables().camera.origin;
  diagnostics_.note(default_sensor_->location,
                    fmt::format("the scene has no sensor: the picture is taken from ({:.4g}, {:.4g}, {:.4g}) along +z, "
                                "{:g} degrees wide",
                                origin[0], origin[1], origin[2], kDefaultFieldOfView),
                    "a <sensor> for another one");
}

}  // namespace norrsken
