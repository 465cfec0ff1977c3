// Readers of mesh files. All take the file's bytes and complain with the file's line where it has lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/mesh_data.h"
#include "norrsken/diagnostics.h"

namespace norrsken {

/// Wavefront OBJ: v, vt, vn, f with any polygon (fan-triangulated) and negative indices; other statements are skipped.
/// Where only some corners have normals or texture coordinates, the others get their triangle's normal and (0, 0).
std::optional<MeshData> read_obj(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

/// Stanford PLY: ascii, binary little and big endian; vertex x y z [nx ny nz] [u v | s t], polygon faces.
std::optional<MeshData> read_ply(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

}  // namespace norrsken
