// From a file, a text or a description to a scene's tables.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "compile/compile.h"

namespace norrsken {

/// Scene::load. Empty after complaints, which are sorted.
std::optional<LoadedScene> load_scene(const SceneSource& source, const LoadOptions& options, Diagnostics& diagnostics);

/// Scene::build.
std::optional<LoadedScene> build_scene(const Description& description, const LoadOptions& options,
                                       std::map<std::string, std::string> files_by_path, Diagnostics& diagnostics);

}  // namespace norrsken
