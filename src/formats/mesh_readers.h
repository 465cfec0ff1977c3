// Readers of mesh files. All take the file's bytes and complain with the file's line where it has lines. Polygons are cut
// into triangles by formats/polygon.h. What is left out with a warning (formats/mesh_flaws.h): numbers that are not finite,
// faces of fewer than three corners; a mesh without faces is empty.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh_data.h"
#include "norrsken/diagnostics.h"

namespace norrsken {

/// What an OBJ file says of materials. Which one a triangle has is an attribute of the mesh: a number among `names`, or -1.
struct ObjMaterials {
  static constexpr std::string_view kAttribute = "face_material";
  std::set<std::string> libraries = {};  ///< of mtllib
  std::vector<std::string> names = {};   ///< of usemtl, each once
  bool is_smooth = false;                ///< a smoothing group was begun
};

/// Wavefront OBJ: v, vt, vn, f with any polygon and negative indices; other statements are skipped. A byte order mark may
/// come first, lines end with LF, CRLF or CR. A file without faces is an error, as any text would be an empty mesh.
/// Where only some corners have normals or texture coordinates, the others get their triangle's normal and (0, 0).
std::optional<MeshData> read_obj(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);
std::optional<MeshData> read_obj_with_materials(std::string_view bytes, const std::string& path,
                                                Diagnostics& diagnostics, ObjMaterials& materials);

/// Stanford PLY: ascii, binary little and big endian; vertex x y z [nx ny nz] [texture coordinates by the names of
/// formats/ply_attributes.h], polygon faces, whose corners may have texture coordinates of their own (a list `texcoord`),
/// attributes of vertices and faces by the rules of formats/ply_attributes.h.
std::optional<MeshData> read_ply(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

/// STL, text or binary: triangles that are flat, one after the other. What the file says of their normals is left out: the
/// corners' order tells the front.
std::optional<MeshData> read_stl(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

/// Mitsuba's serialized meshes, versions 3 and 4: the mesh of that number in the file, from 0 on. Vertex colours become
/// the attribute "vertex_color".
std::optional<MeshData> read_serialized(std::string_view bytes, std::int64_t shape_index, const std::string& path,
                                        Diagnostics& diagnostics);

}  // namespace norrsken
