// Reader for glTF 2.0: .gltf and .glb.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken {

/// Whether a file that begins so is glTF.
bool looks_like_gltf(std::string_view bytes);

/// Reads the scene with what it names. Empty after complaints. `parameters` are the -D values: what they choose is in
/// docs/gltf.md; one that is none of those is an error.
std::optional<Description> read_gltf(const std::string& path, const FileSystem& files,
                                     const std::vector<std::pair<std::string, std::string>>& parameters,
                                     Diagnostics& diagnostics);

}  // namespace norrsken
