#include "displaced_sphere.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <new>
#include <numbers>
#include <string>

namespace norrsken {
namespace {

struct Vertex {
  glm::dvec3 position, normal;
  double u, v;
};

/// Neither the poles nor the seam are special: waves of the direction, coarse and fine.
glm::dvec3 surface_point(double u, double v) {
  const double theta = std::numbers::pi * v, phi = 2 * std::numbers::pi * u;
  const glm::dvec3 d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  const double wave = std::sin(7 * d.x + 2 * d.y) * std::sin(6 * d.y - d.z) + std::sin(8 * d.z + 3 * d.x);
  const double ripple = std::sin(61 * d.x) * std::sin(53 * d.y) * std::sin(57 * d.z);
  return glm::dvec3(5, 0, 0) + (2.4 + 0.15 * wave + 0.03 * ripple) * d;
}

Vertex make_vertex(const SphereGrid& grid, std::uint32_t row, std::uint32_t column) {
  constexpr double kStep = 1e-5;
  // The first and the last row are small circles around the poles, so that no triangle is without an area.
  const double u = static_cast<double>(column) / grid.columns, v = (row + 0.05) / (grid.rows + 0.1);
  const double seam_free_u = column == grid.columns ? 0 : u;
  Vertex vertex{surface_point(seam_free_u, v), {}, u, v};
  const glm::dvec3 du = surface_point(seam_free_u + kStep, v) - surface_point(seam_free_u - kStep, v);
  const glm::dvec3 dv = surface_point(seam_free_u, v + kStep / 2) - surface_point(seam_free_u, v - kStep / 2);
  vertex.normal = glm::normalize(glm::cross(dv, du));
  return vertex;
}

/// Calls `each` with the three corners of every triangle, counter-clockwise from outside.
template <class Each>
void for_each_triangle(const SphereGrid& grid, Each&& each) {
  const auto vertex = [&](std::uint32_t row, std::uint32_t column) { return row * (grid.columns + 1) + column; };
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      each(vertex(row, column), vertex(row + 1, column), vertex(row + 1, column + 1));
      each(vertex(row, column), vertex(row + 1, column + 1), vertex(row, column + 1));
    }
  }
}

template <class Each>
void for_each_vertex(const SphereGrid& grid, Each&& each) {
  for (std::uint32_t row = 0; row <= grid.rows; ++row) {
    for (std::uint32_t column = 0; column <= grid.columns; ++column) each(make_vertex(grid, row, column));
  }
}

template <class Value>
void put(std::string& buffer, Value value) {
  buffer.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Collects text and hands it on in large pieces.
class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { flush(); }
  std::string& buffer() {
    if (buffer_.size() > (1u << 20)) flush();
    return buffer_;
  }

 private:
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::ostream& out_;
  std::string buffer_;
};

/// The same, deflated.
class Deflater {
 public:
  explicit Deflater(std::ostream& out) : out_(out) {
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  ~Deflater() { deflateEnd(&stream_); }
  std::string& buffer() {
    if (buffer_.size() > (1u << 20)) write(Z_NO_FLUSH);
    return buffer_;
  }
  void finish() { write(Z_FINISH); }

 private:
  void write(int flush) {
    stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
    stream_.avail_in = static_cast<uInt>(buffer_.size());
    do {
      char deflated[1 << 16];
      stream_.next_out = reinterpret_cast<Bytef*>(deflated);
      stream_.avail_out = sizeof deflated;
      deflate(&stream_, flush);
      out_.write(deflated, static_cast<std::streamsize>(sizeof deflated - stream_.avail_out));
    } while (stream_.avail_out == 0);
    buffer_.clear();
  }

  std::ostream& out_;
  std::string buffer_;
  z_stream stream_{};
};

std::ofstream open(const std::filesystem::path& path) {
  std::ofstream out(path, std::ios::binary);
  out.exceptions(std::ios::failbit | std::ios::badbit);
  return out;
}

std::string scene(const std::string& format) {
  return fmt::format(
      "<scene version=\"3.0.0\">\n    <path value=\"builtin:\"/>\n    <include "
      "filename=\"builtin:hexagon_room.xml\"/>\n"
      "    <shape type=\"{0}\">\n        <string name=\"filename\" value=\"mesh.{0}\"/>\n"
      "        <bsdf type=\"diffuse\"/>\n    </shape>\n</scene>\n",
      format);
}

}  // namespace

SphereGrid sphere_grid(std::uint32_t triangles, bool bare) {
  const auto rows = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 4.0)));
  return {rows, triangles / (2 * rows), bare};
}

void write_ply(const SphereGrid& grid, std::ostream& to) {
  Writer out(to);
  out.buffer() += fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "{}element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      grid.vertex_count(),
      grid.bare ? "" : "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n",
      grid.triangle_count());
  for_each_vertex(grid, [&](const Vertex& v) {
    std::string& buffer = out.buffer();
    for (int k = 0; k < 3; ++k) put(buffer, static_cast<float>(v.position[k]));
    if (grid.bare) return;
    for (int k = 0; k < 3; ++k) put(buffer, static_cast<float>(v.normal[k]));
    put(buffer, static_cast<float>(v.u));
    put(buffer, static_cast<float>(v.v));
  });
  for_each_triangle(grid, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::string& buffer = out.buffer();
    put(buffer, std::uint8_t{3});
    for (const std::uint32_t corner : {a, b, c}) put(buffer, corner);
  });
}

void write_obj(const SphereGrid& grid, std::ostream& to) {
  Writer out(to);
  for_each_vertex(grid, [&](const Vertex& v) {
    const auto end = std::back_inserter(out.buffer());
    fmt::format_to(end, "v {:.6f} {:.6f} {:.6f}\n", v.position.x, v.position.y, v.position.z);
    if (grid.bare) return;
    fmt::format_to(end, "vt {:.6f} {:.6f}\nvn {:.4f} {:.4f} {:.4f}\n", v.u, v.v, v.normal.x, v.normal.y, v.normal.z);
  });
  for_each_triangle(grid, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto end = std::back_inserter(out.buffer());
    if (grid.bare) {
      fmt::format_to(end, "f {} {} {}\n", a + 1, b + 1, c + 1);
    } else {
      fmt::format_to(end, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", a + 1, b + 1, c + 1);
    }
  });
}

void write_serialized(const SphereGrid& grid, std::ostream& to) {
  constexpr std::uint16_t kMagic = 0x041c, kVersion = 4;
  constexpr std::uint32_t kNormals = 0x0001, kTexcoords = 0x0002, kSingle = 0x1000;
  std::string ends;
  put(ends, kMagic);
  put(ends, kVersion);
  to << ends;
  Deflater out(to);
  put(out.buffer(), grid.bare ? kSingle : kSingle | kNormals | kTexcoords);
  put(out.buffer(), '\0');  // the mesh's name
  put(out.buffer(), std::uint64_t{grid.vertex_count()});
  put(out.buffer(), std::uint64_t{grid.triangle_count()});
  const auto put_vector = [&](const glm::dvec3& v) {
    std::string& buffer = out.buffer();
    for (int k = 0; k < 3; ++k) put(buffer, static_cast<float>(v[k]));
  };
  for_each_vertex(grid, [&](const Vertex& v) { put_vector(v.position); });
  if (!grid.bare) {
    for_each_vertex(grid, [&](const Vertex& v) { put_vector(v.normal); });
    for_each_vertex(grid, [&](const Vertex& v) {
      put(out.buffer(), static_cast<float>(v.u));
      put(out.buffer(), static_cast<float>(v.v));
    });
  }
  for_each_triangle(grid, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t corner : {a, b, c}) put(out.buffer(), corner);
  });
  out.finish();
  ends.clear();
  put(ends, std::uint64_t{0});  // where the one mesh begins
  put(ends, std::uint32_t{1});
  to << ends;
}

std::filesystem::path write_scene(const SphereGrid& grid, const std::string& format,
                                  const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::filesystem::path mesh = folder / ("mesh." + format);
  {
    std::ofstream out = open(mesh);
    (format == "ply" ? write_ply : format == "obj" ? write_obj : write_serialized)(grid, out);
  }
  open(folder / "scene.xml") << scene(format);
  return mesh;
}

}  // namespace norrsken
