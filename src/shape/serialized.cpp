// serialized: a mesh of triangles from a file in Mitsuba's own format.
//
// A mesh whose flags ask for face normals is flat whatever `face_normals` says. Colours of vertices are the attribute
// `vertex_color`.
#include "formats/mesh_readers.h"
#include "shape/mesh_host.h"

namespace norrsken {
namespace {

constexpr IntegerParameter kShapeIndex{
    .name = "shape_index", .fallback = 0, .min = 0, .max = 0xffffffff, .text = "which of the file's meshes"};

}  // namespace

std::optional<ShapeGeometry> compile_shape_serialized(Parameters& p, Shapes& shapes) {
  const std::int64_t shape_index = p.read(kShapeIndex);
  const auto read = [shape_index](std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
    return read_serialized(bytes, shape_index, path, diagnostics);
  };
  return compile_mesh_file(p, shapes, read, std::nullopt);
}

}  // namespace norrsken
