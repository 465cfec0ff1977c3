#include "render/scene_state.h"

#include "render/scene_view.h"
#include "scene/within_memory.h"

namespace norrsken {

SceneState::SceneState(LoadedScene scene)
    : loaded_(std::move(scene)), tables_view_(make_scene_view(loaded_.tables, AccelView{})) {}

std::shared_ptr<const Accel> SceneState::build(Key key, int threads, Diagnostics& diagnostics) const {
  const MemoryScope scope(loaded_.memory);
  SourceLocation whole_file;
  whole_file.file = loaded_.file;
  std::shared_ptr<const Accel> accel;
  try {
    within_memory(whole_file, "the scene's acceleration structure", diagnostics,
                  [&] { accel = std::make_shared<const Accel>(loaded_.tables, key.first, key.second, threads); });
  } catch (const LoadingStopped&) {
    // It has been said why.
  } catch (const AccelFailed& failed) {
    diagnostics.error(whole_file, failed.what());
  }
  return accel;
}

std::shared_ptr<const Accel> SceneState::accel(AccelKind kind, const SceneLayers& layers, int threads,
                                               Diagnostics& diagnostics) const {
  // Only planes merge triangles.
  const Key key{kind, kind == AccelKind::planes ? variation_of(layers) : Variation::none};
  const std::lock_guard lock(mutex_);
  if (const auto known = accels_.find(key); known != accels_.end()) return known->second;
  const auto is_unused = [](const auto& entry) { return entry.second.use_count() == 1; };
  Diagnostics first_try;
  std::shared_ptr<const Accel> accel = build(key, threads, first_try);
  if (!accel && std::erase_if(accels_, is_unused) > 0) {
    accel = build(key, threads, diagnostics);
  } else if (!accel) {
    for (const Diagnostic& d : first_try.all()) diagnostics.error(d.location, d.message, d.accepted);
  }
  if (!accel) return nullptr;
  ++structures_built_;
  accels_[key] = accel;
  return accel;
}

std::uint64_t SceneState::structures_built() const {
  const std::lock_guard lock(mutex_);
  return structures_built_;
}

SceneView SceneState::view(const SceneFrame& frame, const AccelView& accel) const {
  SceneView view = tables_view_;
  set_frame(view, frame, loaded_.tables);
  view.accel = accel;
  return view;
}

}  // namespace norrsken
