// From the description to the tables: gives every plugin name its meaning.
#pragma once

#include <optional>

#include "norrsken/diagnostics.h"
#include "norrsken/scene.h"
#include "scene/description.h"
#include "scene/file_system.h"
#include "tables/layers.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// A scene ready to be rendered, with the names that its users know its parts by.
struct LoadedScene {
  std::shared_ptr<MemoryBudget> memory;  ///< that the tables are counted in
  std::string file;                      ///< for complaints about the scene as a whole
  SceneTables tables;
  SceneLayers layers;
  std::vector<std::string> shape_ids;  ///< those that the scene gives its shapes, by their indices; may be shorter
  SceneInfo info;                      ///< all but `accelerator`, which is chosen when rendering
};

/// Compiles a description. Overrides in `options` (integrator, sampler, size, samples) win over the scene's own nodes;
/// their complaints have no location. Empty if `diagnostics` holds any error, one of the reader's included.
std::optional<LoadedScene> compile(const Description& description, const FileSystem& files, const LoadOptions& options,
                                   Diagnostics& diagnostics);

}  // namespace norrsken
