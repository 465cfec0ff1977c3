// Scene of include/norrsken/scene.h, and version().
#include "norrsken/scene.h"

#include <utility>

#include "compile/load.h"
#include "norrsken/version.h"
#include "render/scene_state.h"

namespace norrsken {

const char* version() noexcept { return NORRSKEN_VERSION; }

Result<Scene> Scene::finish(std::optional<LoadedScene>& loaded, Diagnostics diagnostics) {
  if (!loaded) return diagnostics;
  auto state = std::make_shared<const SceneState>(*std::move(loaded));
  auto frame = std::make_shared<const SceneFrame>(state->loaded().frame(state->loaded().view));
  return {Scene(std::move(state), std::move(frame)), std::move(diagnostics)};
}

Result<Scene> Scene::load(const SceneSource& source, const LoadOptions& options) {
  Diagnostics diagnostics(options.log);
  std::optional<LoadedScene> loaded = load_scene(source, options, diagnostics);
  return finish(loaded, std::move(diagnostics));
}

Result<Scene> Scene::build(const Description& description, const LoadOptions& options,
                           std::map<std::string, std::string> files) {
  Diagnostics diagnostics(options.log);
  std::optional<LoadedScene> loaded = build_scene(description, options, std::move(files), diagnostics);
  return finish(loaded, std::move(diagnostics));
}

Result<Scene> Scene::with(const ViewOptions& options) const {
  Diagnostics diagnostics;
  std::optional<SceneFrame> frame = compile_frame(tables(), *frame_, options, diagnostics);
  if (!frame) return diagnostics;
  return {Scene(state_, std::make_shared<const SceneFrame>(*std::move(frame))), std::move(diagnostics)};
}

SceneInfo Scene::info() const {
  SceneInfo info = tables().info;
  if (frame_->is_as_loaded) return info;
  const auto others = info.items.begin() + static_cast<std::ptrdiff_t>(tables().frame_items);
  info.items.erase(info.items.begin(), others);
  // That of a scene without a sensor comes last, when its bounds are known.
  std::erase_if(info.items, [](const SceneInfo::Item& item) { return item.kind == "sensor"; });
  info.items.insert(info.items.begin(), frame_->items.begin(), frame_->items.end());
  info.width = frame_->film.width, info.height = frame_->film.height;
  info.samples_per_pixel = static_cast<int>(frame_->sampler.samples_per_pixel);
  info.max_depth = frame_->integrator.max_depth;
  info.rr_depth = frame_->integrator.rr_depth;
  info.emitter_samples = frame_->integrator.emitter_samples;
  info.sensor = frame_->sensor, info.sensor_id = frame_->sensor_id;
  info.integrator = frame_->integrator_name, info.sampler = frame_->sampler_name;
  info.memory.film = frame_->film_bytes, info.memory.image = frame_->image_bytes;
  return info;
}

std::uint64_t Scene::structures_built() const { return state_->structures_built(); }

const LoadedScene& Scene::tables() const { return state_->loaded(); }

}  // namespace norrsken
