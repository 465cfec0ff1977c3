// A mesh file as a scene: framed, lit, on a floor.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "norrsken/diagnostics.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken {

bool looks_like_ply(std::string_view bytes);
bool looks_like_stl(std::string_view bytes);

/// A PLY, OBJ (with the materials that it names) or STL file, told by its name, else by its contents. y is up, of STL files
/// z. Empty after complaints.
std::optional<Description> read_bare_mesh(const std::string& path, const FileSystem& files, Diagnostics& diagnostics);

}  // namespace norrsken
