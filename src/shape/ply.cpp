// ply: a mesh of triangles from a Stanford PLY file.
//
// Parameters: those of all mesh files (shape/mesh_host.h); flip_tex_coords defaults to false, as in Mitsuba.
#include "compile/plugins.h"
#include "formats/mesh_readers.h"
#include "shape/mesh_host.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_ply(Parameters& p, Builder& builder) {
  return compile_mesh_file(p, builder, read_ply, /*flip_tex_coords=*/false);
}

}  // namespace norrsken
