// Readers of mesh files. All take the file's bytes and complain with the file's line where it has lines.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/mesh_data.h"
#include "norrsken/diagnostics.h"

namespace norrsken {

/// Wavefront OBJ: v, vt, vn, f with any polygon (fan-triangulated) and negative indices; other statements are skipped.
/// Where only some corners have normals or texture coordinates, the others get their triangle's normal and (0, 0).
std::optional<MeshData> read_obj(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

/// Stanford PLY: ascii, binary little and big endian; vertex x y z [nx ny nz] [u v | texture_u texture_v | s t], polygon
/// faces (fan-triangulated), attributes of vertices and faces by the rules of formats/ply_attributes.h.
std::optional<MeshData> read_ply(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

/// Mitsuba's serialized meshes, versions 3 and 4: the mesh of that number in the file, from 0 on. Vertex colours become
/// the attribute "vertex_color".
std::optional<MeshData> read_serialized(std::string_view bytes, std::int64_t shape_index, const std::string& path,
                                        Diagnostics& diagnostics);

}  // namespace norrsken
