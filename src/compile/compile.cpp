#include "compile/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "base/text.h"
#include "compile/builder.h"
#include "compile/crop_window.h"
#include "scene/check_description.h"
#include "scene/within_memory.h"

namespace norrsken {
namespace {

/// Calls `build`, in the memory budget; false after a complaint.
bool built(const Description& description, Diagnostics& diagnostics, const std::function<void()>& build) {
  try {
    within_memory(description.scene->location, "the scene", diagnostics, build);
  } catch (const LoadingStopped&) {
    return false;
  }
  return !diagnostics.has_errors();
}

/// `next` said over `before`, which `frame` came of.
ViewOptions merged(const ViewOptions& before, const ViewOptions& next, const FilmSettings& film) {
  ViewOptions view = before;
  if (next.sensor || next.sensor_node) {
    if (next.sensor) view.sensor = next.sensor;
    view.sensor_node = next.sensor_node;
    view.camera.clear();
  }
  for (const Property& property : next.camera) {
    std::erase_if(view.camera, [&](const Property& known) { return known.name == property.name; });
    view.camera.push_back(property);
  }
  // Another size shows the same part of the picture.
  if (view.crop && next.width.value_or(0) >= 1)
    scale_window(view.crop->x, view.crop->width, film.full_width, *next.width);
  if (view.crop && next.height.value_or(0) >= 1)
    scale_window(view.crop->y, view.crop->height, film.full_height, *next.height);
  if (next.crop) view.crop = next.crop;
  if (next.width) view.width = next.width;
  if (next.height) view.height = next.height;
  if (next.integrator || next.integrator_node)
    view.integrator = next.integrator, view.integrator_node = next.integrator_node;
  if (next.sampler || next.sampler_node) view.sampler = next.sampler, view.sampler_node = next.sampler_node;
  if (next.samples_per_pixel) view.samples_per_pixel = next.samples_per_pixel;
  return view;
}

struct ValueText {
  std::string operator()(bool v) const { return v ? "true" : "false"; }
  std::string operator()(std::int64_t v) const { return fmt::to_string(v); }
  std::string operator()(double v) const { return fmt::format("{}", v); }
  std::string operator()(const std::string& v) const { return v; }
  std::string operator()(const Property::Rgb& v) const { return fmt::format("{}", fmt::join(v.value, ",")); }
  std::string operator()(const Property::Vector& v) const { return fmt::format("{}", fmt::join(v.value, ",")); }
  std::string operator()(const Property::Transform& v) const {
    std::string text;
    for (const auto& row : v.rows) text += fmt::format("{}{}", text.empty() ? "" : ",", fmt::join(row, ","));
    return text;
  }
  std::string operator()(const Property::Spectrum&) const { return "a spectrum"; }
  template <class T>
  std::string operator()(const std::shared_ptr<const T>&) const {
    return "an array";
  }
};

std::string text_of(const Property::Value& value) { return std::visit(ValueText{}, value); }

/// What of a sensor is not what its scene says, for image files.
std::string text_of_camera(const ViewOptions& view) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : " ") + part; };
  if (view.sensor) add("sensor " + *view.sensor);
  if (view.sensor_node) {
    add(view.sensor_node->plugin);
    for (const Property& property : view.sensor_node->properties) add(property.name + "=" + text_of(property.value));
  }
  for (const Property& property : view.camera) add(property.name + "=" + text_of(property.value));
  return text;
}

/// As when a scene is loaded, but for all of it at once: shapes are not remembered.
void warn_of_far_clip(const LoadedScene& scene, const CameraRecord& camera, Diagnostics& diagnostics) {
  glm::dvec3 middle, half;
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = (scene.info.bounds_max[axis] + scene.info.bounds_min[axis]) / 2;
    half[axis] = (scene.info.bounds_max[axis] - scene.info.bounds_min[axis]) / 2;
  }
  const glm::dvec3 forward(camera.forward[0], camera.forward[1], camera.forward[2]);
  const glm::dvec3 origin(camera.origin[0], camera.origin[1], camera.origin[2]);
  const double farthest = glm::dot(middle - origin, forward) + glm::dot(half, glm::abs(forward));
  if (farthest <= static_cast<double>(camera.far_clip)) return;
  diagnostics.warning({}, fmt::format("what is farther away than 'far_clip', {:g}, is not seen", camera.far_clip),
                      fmt::format("a far_clip of at least {:.3g}", farthest));
}

}  // namespace

std::string AskedOfIntegrator::difference(const IntegratorSettings& integrator) const {
  if (from_lights && *from_lights != integrator.from_lights)
    return integrator.from_lights ? "its paths begin at the lights" : "its paths begin at the camera";
  if (finds_lights && *finds_lights != integrator.finds_lights())
    return integrator.finds_lights() ? "its paths find lights by themselves"
                                     : "its paths do not find lights by themselves";
  return {};
}

SceneFrame LoadedScene::frame(const ViewOptions& looked_at) const {
  SceneFrame frame;
  frame.is_as_loaded = true;
  frame.camera = tables.camera;
  frame.batch = tables.batch;
  frame.meter = tables.meter;
  frame.film = tables.film;
  frame.filter = tables.filter;
  frame.sampler = tables.sampler;
  frame.integrator = tables.integrator;
  frame.layers = layers;
  frame.integrator_name = info.integrator, frame.sampler_name = info.sampler;
  frame.items.assign(info.items.begin(), info.items.begin() + static_cast<std::ptrdiff_t>(frame_items));
  frame.film_bytes = info.memory.film, frame.image_bytes = info.memory.image;
  frame.sensor = info.sensor, frame.sensor_id = info.sensor_id;
  frame.view = looked_at;
  return frame;
}

Variation variation_of(const SceneLayers& layers) {
  Variation variation = Variation::none;
  for (const FeatureLayer& layer : layers.features) {
    if (layer.feature == kFeaturePrimitive) return Variation::by_triangle;
    if ((1u << layer.feature & kUvFeatures) != 0) variation = Variation::over_uv;
  }
  return variation;
}

ViewOptions view_of(const LoadOptions& options) {
  ViewOptions view;
  view.sensor = options.sensor;
  view.width = options.width, view.height = options.height;
  view.integrator = options.integrator, view.sampler = options.sampler;
  view.samples_per_pixel = options.samples_per_pixel;
  return view;
}

std::optional<LoadedScene> compile(const Description& description, const FileSystem& files, const LoadOptions& options,
                                   Diagnostics& diagnostics) {
  const MemoryScope scope(options.memory ? options.memory : MemoryBudget::of_machine());
  LoadedScene scene;
  if (!built(description, diagnostics, [&] { scene = Builder(description, files, diagnostics).build(options); }))
    return std::nullopt;
  return scene;
}

std::optional<SceneFrame> compile_frame(const LoadedScene& scene, const SceneFrame& frame, const ViewOptions& changes,
                                        Diagnostics& diagnostics) {
  const MemoryScope scope(scene.memory);
  const ViewOptions view = merged(frame.view, changes, frame.film);
  Description given;  // what a program puts together
  Node nodes("scene");
  const auto take = [&](const std::optional<Node>& node, std::string_view kind) {
    if (!node) return true;
    if (node->kind != kind || node->plugin.empty()) {
      diagnostics.error({}, fmt::format("{} in place of a {}", name_of(*node), kind),
                        fmt::format("a node of kind {}, with a plugin", kind));
      return false;
    }
    nodes.add(*node);
    return true;
  };
  if (!take(changes.sensor_node, "sensor") || !take(changes.integrator_node, "integrator") ||
      !take(changes.sampler_node, "sampler"))
    return std::nullopt;
  Node camera;
  camera.properties = changes.camera;
  nodes.add(std::move(camera));
  given.scene = std::make_shared<const Node>(std::move(nodes));
  if (!check_description(given, diagnostics)) return std::nullopt;

  std::optional<SceneFrame> made;
  const FileSystem files;  // neither sensors nor integrators name any
  if (!built(scene.outline, diagnostics,
             [&] { made = Builder(scene.outline, files, diagnostics).build_frame(view, scene.media); }))
    return std::nullopt;
  if (const std::string difference = scene.asked.difference(made->integrator); !difference.empty()) {
    diagnostics.error({},
                      fmt::format("the lights of the scene were prepared for another integrator than {}: {}",
                                  quoted(made->integrator_name), difference),
                      "the scene loaded with that integrator");
    return std::nullopt;
  }
  made->is_as_loaded = false;
  made->changes = frame.changes;
  if (changes.sensor || changes.sensor_node || !changes.camera.empty()) {
    made->changes = text_of_camera(view);
    warn_of_far_clip(scene, made->camera, diagnostics);
  }
  return made;
}

}  // namespace norrsken
