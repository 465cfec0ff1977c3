// Scenes of one language in another.
#pragma once

#include <string>
#include <vector>

#include "norrsken/scene.h"

namespace norrsken {

/// Reads a scene of any format and writes it to `path`, which ends with .xml, as Mitsuba 3 does, with meshes and images in a
/// folder beside it. Of `options` the parameters, the memory and the log count. The value is the names of what was written.
/// Errors: what Scene::load complains of when it reads, and files that cannot be written.
Result<std::vector<std::string>> convert_scene(const SceneSource& source, const std::string& path,
                                               const LoadOptions& options = {});

}  // namespace norrsken
