// serialized: a mesh of triangles from a file in Mitsuba's own format.
//
// Parameters: those of all mesh files (shape/mesh_host.h) but flip_tex_coords, and
//   shape_index  integer, 0 or more (default 0): which of the file's meshes
// A mesh whose flags ask for face normals is flat whatever `face_normals` says. Colours of vertices are the attribute
// `vertex_color`.
#include "compile/plugins.h"
#include "formats/mesh_readers.h"
#include "shape/mesh_host.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_serialized(Parameters& p, Builder& builder) {
  const std::int64_t shape_index = p.integer("shape_index", 0, 0, 0xffffffff);
  const auto read = [shape_index](std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
    return read_serialized(bytes, shape_index, path, diagnostics);
  };
  return compile_mesh_file(p, builder, read, std::nullopt);
}

}  // namespace norrsken
