// obj: a mesh of triangles from a Wavefront OBJ file.
//
// Parameters: those of all mesh files (shape/mesh_host.h); flip_tex_coords defaults to true, as in Mitsuba.
#include "compile/plugins.h"
#include "formats/mesh_readers.h"
#include "shape/mesh_host.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_obj(Parameters& p, Builder& builder) {
  return compile_mesh_file(p, builder, read_obj, /*flip_tex_coords=*/true);
}

}  // namespace norrsken
