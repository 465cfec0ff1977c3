// Writes a mesh as binary PLY, as read_ply reads it.
#pragma once

#include <string>

#include "norrsken/description.h"

namespace norrsken {

/// Empty, or what went wrong.
std::string write_ply(const std::string& path, const Mesh& mesh);

}  // namespace norrsken
