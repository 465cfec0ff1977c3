// obj: a mesh of triangles from a Wavefront OBJ file.
#include "formats/mesh_readers.h"
#include "shape/mesh_host.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_obj(Parameters& p, Shapes& shapes) {
  return compile_mesh_file(p, shapes, read_obj, kFlipTexCoords.or_else(true));
}

}  // namespace norrsken
