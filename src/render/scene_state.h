// A loaded scene with what renderings of it share: made when it is first asked for, and once.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "accel/build.h"
#include "compile/compile.h"
#include "tables/wave_types.h"

namespace norrsken {

class SceneState {
 public:
  explicit SceneState(LoadedScene scene);

  const LoadedScene& loaded() const { return loaded_; }

  /// The acceleration structure of that kind for a frame's layers, in the scene's budget: structures that nobody uses any
  /// more make room if there is none. Null after a complaint. Any thread may ask; those that come while it is being built
  /// wait for it. `threads` may help to build it; it is the same for any number.
  std::shared_ptr<const Accel> accel(AccelKind kind, const SceneLayers& layers, int threads,
                                     Diagnostics& diagnostics) const;
  std::uint64_t structures_built() const;

  /// The scene as kernels see it in a frame, which must outlive the view, as `accel` must.
  SceneView view(const SceneFrame& frame, const AccelView& accel) const;

 private:
  using Key = std::pair<AccelKind, Variation>;
  std::shared_ptr<const Accel> build(Key key, int threads, Diagnostics& diagnostics) const;

  const LoadedScene loaded_;
  const SceneView tables_view_;  ///< of the tables alone
  mutable std::mutex mutex_;     ///< for what follows
  mutable std::map<Key, std::shared_ptr<const Accel>> accels_;
  mutable std::uint64_t structures_built_ = 0;
};

}  // namespace norrsken
