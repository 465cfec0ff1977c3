// ply: a mesh of triangles from a Stanford PLY file.
//
// ASCII and binary files of either byte order; faces of any number of corners. Texture coordinates are properties u v, s t,
// texture_u texture_v, texture_s texture_t, texcoord_u texcoord_v or texcoord_s texcoord_t of vertices, or a list texcoord
// of faces, with two numbers for each corner. Other properties are attributes for
// textures of type `mesh_attribute`: consecutive PREFIX_x _y _z, PREFIX_0 _1 _2, PREFIX_1 _2 _3, or the first of those
// alone, of vertices are `vertex_PREFIX`, of faces `face_PREFIX`; PREFIX_r _g _b are `vertex_PREFIX_color`; r g b and red
// green blue are `vertex_color`. Integers are stored colours: the type's greatest value is 1, and sRGB is decoded.
#include "formats/mesh_readers.h"
#include "shape/mesh_host.h"

namespace norrsken {

std::optional<ShapeGeometry> compile_shape_ply(Parameters& p, Shapes& shapes) {
  return compile_mesh_file(p, shapes, read_ply, kFlipTexCoords);
}

}  // namespace norrsken
