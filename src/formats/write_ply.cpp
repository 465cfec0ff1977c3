#include "formats/write_ply.h"

#include <fmt/format.h>

#include <bit>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"

namespace norrsken {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Columns of one kind of element: so many floats of each.
struct Column {
  std::size_t floats;
  const FloatArray* values;
};

/// "vertex_color" becomes color_r, color_g and color_b.
std::string declarations(const Mesh::Attribute& attribute, std::string_view prefix) {
  const std::string name = attribute.name.substr(prefix.size());
  std::string text;
  for (int c = 0; c < attribute.channels; ++c)
    text += name == "color" && attribute.channels == 3 ? fmt::format("property float {}\n", "rgb"[c])
                                                       : fmt::format("property float {}_{}\n", name, c);
  return text;
}

/// What is written at once: calls per element cost more than the elements.
class Buffer {
 public:
  explicit Buffer(AtomicFile& file) : file_(file) {}
  ~Buffer() { flush(); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  void add(const void* bytes, std::size_t count) {
    const char* first = static_cast<const char*>(bytes);
    bytes_.insert(bytes_.end(), first, first + count);
    if (bytes_.size() > (std::size_t{1} << 20)) flush();
  }

 private:
  void flush() {
    file_.write(bytes_.data(), bytes_.size());
    bytes_.clear();
  }
  AtomicFile& file_;
  std::vector<char> bytes_;
};

}  // namespace

std::string write_ply(const std::string& path, const Mesh& mesh) {
  constexpr std::string_view kVertex = "vertex_", kFace = "face_";
  std::vector<Column> vertex{{3, &mesh.positions}}, face;
  std::string vertex_header = "property float x\nproperty float y\nproperty float z\n", face_header;
  if (!mesh.normals.empty()) {
    vertex.push_back({3, &mesh.normals});
    vertex_header += "property float nx\nproperty float ny\nproperty float nz\n";
  }
  if (!mesh.texcoords.empty()) {
    vertex.push_back({2, &mesh.texcoords});
    vertex_header += "property float u\nproperty float v\n";
  }
  for (const Mesh::Attribute& attribute : mesh.attributes) {
    const bool of_faces = attribute.name.starts_with(kFace);
    (of_faces ? face : vertex).push_back({static_cast<std::size_t>(attribute.channels), &attribute.values});
    (of_faces ? face_header : vertex_header) += declarations(attribute, of_faces ? kFace : kVertex);
  }
  const std::size_t vertices = mesh.positions.size() / 3, faces = mesh.triangles.size() / 3;
  const std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n{}element face {}\nproperty list uchar int "
      "vertex_indices\n"
      "{}end_header\n",
      vertices, vertex_header, faces, face_header);
  AtomicFile file;
  if (const IoStatus status = file.create(path); !status) return status.error;
  file.write(header.data(), header.size());
  {
    Buffer buffer(file);
    const auto add = [&](const std::vector<Column>& columns, std::size_t i) {
      for (const Column& column : columns)
        buffer.add(column.values->data() + i * column.floats, column.floats * sizeof(float));
    };
    for (std::size_t i = 0; i < vertices; ++i) add(vertex, i);
    for (std::size_t i = 0; i < faces; ++i) {
      const unsigned char corners = 3;
      buffer.add(&corners, 1);
      buffer.add(&mesh.triangles[3 * i], 3 * sizeof(std::uint32_t));
      add(face, i);
    }
  }
  return file.commit().error;
}

}  // namespace norrsken
