// Reader for Mitsuba's serialized meshes, versions 3 and 4 (the format's description in the manual of the `serialized`
// plugin): little-endian, each mesh deflated by itself, and a dictionary of their places at the end of the file.
//
// Version 3 has no name in front of a mesh and 32-bit places in the dictionary.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "formats/inflater.h"
#include "formats/mesh_complaints.h"
#include "formats/mesh_flaws.h"
#include "formats/mesh_readers.h"
#include "scene/description.h"

namespace norrsken {
namespace {

static_assert(std::endian::native == std::endian::little, "values are taken as they stand in the file");

constexpr std::uint16_t kMagic = 0x041c;
constexpr std::size_t kHeaderBytes = 4;  ///< magic and version, in front of each mesh

enum Flags : std::uint32_t {
  kHasNormals = 0x0001,
  kHasTexcoords = 0x0002,
  kHasColors = 0x0008,
  kFaceNormals = 0x0010,
  kDoublePrecision = 0x2000,
};

template <class T>
T load(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

class SerializedReader {
 public:
  SerializedReader(std::string_view bytes, std::int64_t shape_index, MeshComplaints& complaints)
      : bytes_(bytes), shape_index_(shape_index), complaints_(complaints) {}

  std::optional<MeshData> read() {
    const auto start = find_mesh();
    if (!start) return std::nullopt;
    Inflater input(bytes_.substr(*start), Inflater::Wrapping::zlib);
    if (!read_mesh(input)) {
      if (!complaints_.any())
        complaints_.about_file(fmt::format("mesh {} {}", shape_index_, input.problem()),
                               "a file as Mitsuba's exporters write it");
      return std::nullopt;
    }
    complaints_.tell_flaws();
    leave_out_not_finite(mesh_);
    return std::move(mesh_);
  }

 private:
  std::optional<std::size_t> complain(std::string message, std::string accepted) {
    complaints_.about_file(std::move(message), std::move(accepted));
    return std::nullopt;
  }

  /// Offset of the deflated data.
  std::optional<std::size_t> find_mesh() {
    if (bytes_.size() < kHeaderBytes || load<std::uint16_t>(bytes_, 0) != kMagic)
      return complain("this is no serialized mesh", "a file that begins with the bytes 1C 04");
    version_ = load<std::uint16_t>(bytes_, 2);
    if (version_ != 3 && version_ != 4) return complain(fmt::format("version {}", version_), "3 or 4");
    if (shape_index_ == 0) return kHeaderBytes;

    const std::size_t place_bytes = version_ == 4 ? 8 : 4, end = bytes_.size() - 4;
    const std::uint32_t count = load<std::uint32_t>(bytes_, end);
    const std::string damaged = "the dictionary at the end of the file is damaged";
    if (end < kHeaderBytes || count == 0 || count > (end - kHeaderBytes) / place_bytes)
      return complain(damaged, "the places of all meshes and their number");
    if (shape_index_ >= count)
      return complain(fmt::format("there is no mesh {}", shape_index_),
                      fmt::format("'shape_index' 0 to {}", count - 1));
    const std::size_t entry = end - (count - static_cast<std::size_t>(shape_index_)) * place_bytes;
    const std::uint64_t place = version_ == 4 ? load<std::uint64_t>(bytes_, entry) : load<std::uint32_t>(bytes_, entry);
    if (place > end - kHeaderBytes || load<std::uint16_t>(bytes_, place) != kMagic)
      return complain(damaged, "the places of all meshes and their number");
    return place + kHeaderBytes;
  }

  bool read_mesh(Inflater& input) {
    std::uint32_t flags = 0;
    if (!input.fill(flags)) return false;
    for (char letter = 'a'; version_ == 4 && letter != '\0';) {
      if (!input.fill(letter)) return false;
    }
    std::uint64_t vertices = 0, triangles = 0;
    if (!input.fill(vertices) || !input.fill(triangles)) return false;
    if (vertices == 0 || triangles == 0) {
      complaints_.flaw_at({}, MeshFlaw::no_faces,
                          fmt::format("mesh {} has no {}, nothing of it is drawn", shape_index_,
                                      vertices == 0 ? "vertices" : "triangles"));
      return true;
    }
    if (vertices >= std::numeric_limits<std::uint32_t>::max()) {
      complaints_.about_file(fmt::format("{} vertices are too many", vertices), "fewer than 2^32");
      return false;
    }
    is_double_ = (flags & kDoublePrecision) != 0;
    mesh_.face_normals = (flags & kFaceNormals) != 0;
    if (!read_vertices(input, mesh_.positions, vertices, "position", kMaxCoordinate)) return false;
    if ((flags & kHasNormals) != 0 && !read_vertices(input, mesh_.normals, vertices, "normal")) return false;
    if ((flags & kHasTexcoords) != 0 && !read_vertices(input, mesh_.texcoords, vertices, "texture coordinate"))
      return false;
    if ((flags & kHasColors) != 0) {
      MeshAttribute& color = mesh_.attributes.emplace_back();
      color.name = "vertex_color";
      color.channels = 3;
      if (!may_have(input, 3 * vertices)) return false;
      color.values.resize(3 * vertices);
      if (!read_numbers(input, color.values.data(), 3 * vertices, 3, "color", kMaxFloat)) return false;
    }
    return read_triangles(input, vertices, triangles);
  }

  static constexpr double kMaxFloat = std::numeric_limits<float>::max();

  bool may_have(Inflater& input, std::uint64_t numbers) const { return input.may_have(numbers, number_bytes()); }
  std::size_t number_bytes() const { return is_double_ ? sizeof(double) : sizeof(float); }

  template <std::size_t N>
  bool read_vertices(Inflater& input, Array<std::array<float, N>>& into, std::uint64_t vertices, const char* what,
                     double limit = kMaxFloat) {
    if (!may_have(input, N * vertices)) return false;
    into.resize(vertices);
    return read_numbers(input, into.data()->data(), N * vertices, N, what, limit);
  }

  bool read_numbers(Inflater& input, float* into, std::uint64_t count, std::size_t per_vertex, const char* what,
                    double limit) {
    if (is_double_) {
      double block[1024];
      for (std::uint64_t at = 0; at < count;) {
        const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(count - at, std::size(block)));
        if (!input.fill(block, size * sizeof(double))) return false;
        for (std::size_t i = 0; i < size; ++i) into[at + i] = static_cast<float>(block[i]);
        at += size;
      }
    } else if (!input.fill(into, count * sizeof(float))) {
      return false;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
      if (std::abs(into[i]) <= limit) continue;
      const std::string found = fmt::format("a {} of vertex {} is {:g}", what, i / per_vertex, into[i]);
      if (!std::isfinite(into[i])) {
        complaints_.flaw_at({}, MeshFlaw::not_finite, not_finite_text(found));
        continue;
      }
      complaints_.about_file(found, fmt::format("numbers from {:g} to {:g}", -limit, limit));
      if (complaints_.gave_up()) return false;
    }
    return !complaints_.any();
  }

  bool read_triangles(Inflater& input, std::uint64_t vertices, std::uint64_t triangles) {
    constexpr std::size_t kTriangleBytes = 3 * sizeof(std::uint32_t);
    if (!input.may_have(triangles, kTriangleBytes)) return false;
    mesh_.triangles.resize(triangles);
    if (!input.fill(mesh_.triangles.data(), triangles * kTriangleBytes)) return false;
    for (std::uint64_t i = 0; i < triangles; ++i) {
      for (const std::uint32_t vertex : mesh_.triangles[i]) {
        if (vertex < vertices) continue;
        complaints_.about_file(fmt::format("triangle {} has a vertex {}", i, vertex),
                               fmt::format("0 to {}", vertices - 1));
        if (complaints_.gave_up()) return false;
      }
    }
    return !complaints_.any();
  }

  std::string_view bytes_;
  std::int64_t shape_index_;
  MeshComplaints& complaints_;
  MeshData mesh_;
  std::uint16_t version_ = 0;
  bool is_double_ = false;
};

}  // namespace

std::optional<MeshData> read_serialized(std::string_view bytes, std::int64_t shape_index, const std::string& path,
                                        Diagnostics& diagnostics) {
  MeshComplaints complaints(path, bytes, diagnostics);
  try {
    return SerializedReader(bytes, shape_index, complaints).read();
  } catch (const std::bad_alloc&) {
    complaints.about_file("the mesh does not fit into memory");
    return std::nullopt;
  }
}

}  // namespace norrsken
