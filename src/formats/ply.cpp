// Reader for Stanford PLY (Turk 1994): the header says which values follow each other, the body is read in one pass.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <span>

#include "color/srgb.h"
#include "formats/mesh_complaints.h"
#include "formats/mesh_flaws.h"
#include "formats/mesh_readers.h"
#include "formats/ply_attributes.h"
#include "formats/ply_faces.h"
#include "formats/ply_header.h"
#include "formats/ply_input.h"
#include "scene/description.h"

namespace norrsken {
namespace {

constexpr double kMaxFloat = std::numeric_limits<float>::max();

bool is_face_list(const PlyProperty& property) {
  return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Texture coordinates of a face's corners, u and v of one after the other, as MeshLab writes them.
bool is_corner_texcoords(const PlyProperty& property) { return property.count_type && property.name == "texcoord"; }

/// Where a property's values go.
struct Column {
  float* into = nullptr;   ///< the next one; null: nowhere
  std::size_t stride = 0;  ///< in floats
  double limit = kMaxFloat;
  double full_scale = 0;  ///< above 0: the integer that is 1, and values are sRGB-encoded
};

/// Integers of attributes are stored colours, as Mitsuba takes them.
double full_scale(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return std::numeric_limits<std::int8_t>::max();
    case PlyType::uint8:
      return std::numeric_limits<std::uint8_t>::max();
    case PlyType::int16:
      return std::numeric_limits<std::int16_t>::max();
    case PlyType::uint16:
      return std::numeric_limits<std::uint16_t>::max();
    case PlyType::int32:
      return std::numeric_limits<std::int32_t>::max();
    case PlyType::uint32:
      return std::numeric_limits<std::uint32_t>::max();
    case PlyType::float32:
    case PlyType::float64:
      break;
  }
  return 0;
}

template <typename Input>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, std::string_view body, MeshComplaints& complaints)
      : header_(header), complaints_(complaints), input_(body, complaints) {}

  std::optional<MeshData> read() {
    const PlyElement* vertices = find("vertex");
    const PlyElement* faces = find("face");
    if (!faces && find("tristrips")) {
      complaints_.about_file("triangle strips (element 'tristrips') are not read", "faces, in an element 'face'");
      return std::nullopt;
    }
    if (!vertices) {
      complaints_.about_file("the mesh has no vertices", "elements 'vertex' and 'face'");
      return std::nullopt;
    }
    if (!faces) return without_faces();
    if (!check(*vertices, *faces)) return std::nullopt;
    vertex_count_ = vertices->count;
    for (const PlyElement& element : header_.elements) {
      const bool good = &element == vertices ? read_vertices(element)
                        : &element == faces  ? read_faces(element)
                                             : skip(element);
      if (!good) return std::nullopt;
      if (!mesh_.positions.empty() && !mesh_.triangles.empty()) break;
    }
    complaints_.tell_flaws();
    if (complaints_.any()) return std::nullopt;
    if (mesh_.triangles.empty()) return without_faces();
    warn_of_intricate(faces_.finish(), complaints_);
    if (faces_.with_texcoords > 0 && faces_.without_texcoords > 0) {
      complaints_.flaw_at({}, MeshFlaw::no_texcoords,
                          fmt::format("{} of {} faces have no texture coordinates: they get (0, 0)",
                                      faces_.without_texcoords, faces_.with_texcoords + faces_.without_texcoords));
      complaints_.tell_flaws();
    }
    leave_out_not_finite(mesh_);
    return std::move(mesh_);
  }

 private:
  std::optional<MeshData> without_faces() {
    complaints_.flaw_at({}, MeshFlaw::no_faces, "the mesh has no faces, nothing of it is drawn");
    complaints_.tell_flaws();
    return MeshData{};
  }

  const PlyElement* find(std::string_view name) const {
    const auto named = [name](const PlyElement& element) { return element.name == name; };
    const auto found = std::find_if(header_.elements.begin(), header_.elements.end(), named);
    return found == header_.elements.end() ? nullptr : &*found;
  }

  bool check(const PlyElement& vertices, const PlyElement& faces) {
    if (!has(vertices, {"x", "y", "z"})) {
      complaints_.about_file("vertices without a place", "properties x, y and z of element 'vertex'");
      return false;
    }
    if (std::none_of(faces.properties.begin(), faces.properties.end(), is_face_list)) {
      complaints_.about_file("faces without vertices", "a list property 'vertex_indices' of element 'face'");
      return false;
    }
    if (vertices.count < std::numeric_limits<std::uint32_t>::max()) return true;
    complaints_.about_file(fmt::format("{} vertices are too many", vertices.count), "fewer than 2^32");
    return false;
  }

  static bool has(const PlyElement& element, std::initializer_list<std::string_view> names) {
    return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
      return std::any_of(element.properties.begin(), element.properties.end(),
                         [&](const PlyProperty& p) { return !p.count_type && p.name == name; });
    });
  }

  bool ends_early(const PlyElement& element, std::uint64_t row) {
    if (!input_.failed())
      complaints_.about_file(
          fmt::format("the file ends in element '{}' {} of {}", element.name, row + 1, element.count),
          "as many as the header says");
    return false;
  }

  // A count is believed as far as there are bytes for it: more rows than this cannot be read.
  std::size_t rows_to_expect(const PlyElement& element) const {
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += Input::least_size(property.count_type.value_or(property.type));
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(element.count, input_.remaining() / std::max<std::size_t>(least, 1) + 1));
  }

  // Passes over a list; false at the end of the file.
  bool skip_list(const PlyProperty& property) {
    double count = 0, ignored = 0;
    if (!input_.read(*property.count_type, count)) return false;
    for (double i = 0; i < count; ++i) {
      if (!input_.read(property.type, ignored)) return false;
    }
    return true;
  }

  bool skip(const PlyElement& element) {
    if (element.properties.empty()) return true;
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (const PlyProperty& property : element.properties) {
        if (!read_property(element, property, {}, row)) return ends_early(element, row);
      }
    }
    return true;
  }

  // A value that somebody wants; false at the end of the file.
  bool read_value(const PlyElement& element, const PlyProperty& property, const Column& column, std::uint64_t row,
                  float& result) {
    double value = 0;
    if (!input_.read(property.type, value)) return false;
    const auto what = [&] {
      return fmt::format("'{}' of {} {} is {}", property.name, element.name, row,
                         input_.last().empty() ? fmt::format("{}", value) : std::string(input_.last()));
    };
    if (!std::isfinite(value)) {
      complaints_.flaw_at(input_.last(), MeshFlaw::not_finite, not_finite_text(what()));
    } else if (std::abs(value) > column.limit) {
      complain(what(), fmt::format("a number from {:g} to {:g}", -column.limit, column.limit));
      value = 0;
    }
    if (column.full_scale > 0) value = linear_from_srgb(std::clamp(value / column.full_scale, 0.0, 1.0));
    result = static_cast<float>(value);
    return true;
  }

  // One property of one row, stored if somebody wants it; false at the end of the file.
  bool read_property(const PlyElement& element, const PlyProperty& property, const Column& column, std::uint64_t row) {
    if (property.count_type) return skip_list(property);
    if (column.into != nullptr) return read_value(element, property, column, row, *column.into);
    double ignored = 0;
    return input_.read(property.type, ignored);
  }

  // Columns for attributes, which get `rows` values.
  void add_attributes(const PlyElement& element, bool per_face, std::size_t rows, std::vector<Column>& columns) {
    auto found = find_ply_attributes(element, per_face ? "face_" : "vertex_");
    for (PlyAttribute& attribute : found) {
      const std::size_t channels = attribute.properties.size();
      MeshAttribute& stored = mesh_.attributes.emplace_back();
      stored.name = std::move(attribute.name);
      stored.channels = static_cast<std::uint32_t>(channels);
      stored.per_face = per_face;
      stored.values.resize(rows * channels);
      for (std::size_t k = 0; k < channels; ++k) {
        const PlyType type = element.properties[attribute.properties[k]].type;
        columns[attribute.properties[k]] = {stored.values.data() + k, channels, kMaxFloat, full_scale(type)};
      }
    }
  }

  bool read_vertices(const PlyElement& element) {
    if (element.count == 0) return true;
    const std::size_t rows = rows_to_expect(element);
    std::vector<Column> columns(element.properties.size());
    const auto store = [&](auto& values, std::initializer_list<std::string_view> names, double limit) {
      if (!has(element, names)) return false;
      values.resize(rows);
      std::size_t component = 0;
      for (const std::string_view name : names) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
          const PlyProperty& property = element.properties[i];
          if (!property.count_type && property.name == name)
            columns[i] = {values.data()->data() + component, names.size(), limit};
        }
        ++component;
      }
      return true;
    };
    store(mesh_.positions, {"x", "y", "z"}, kMaxCoordinate);
    store(mesh_.normals, {"nx", "ny", "nz"}, kMaxFloat);
    for (const auto& [u, v] : kPlyTexcoordNames) {
      if (store(mesh_.texcoords, {u, v}, kMaxFloat)) break;
    }
    add_attributes(element, false, rows, columns);

    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        Column& column = columns[i];
        const bool good = read_property(element, property, column, row);
        if (complaints_.gave_up()) return false;
        if (!good) return ends_early(element, row);
        column.into += column.stride;
      }
    }
    return true;
  }

  // At the word read last, if the body has words.
  void complain(std::string message, std::string accepted) {
    if (input_.last().empty()) {
      complaints_.about_file(std::move(message), std::move(accepted));
    } else {
      complaints_.at(input_.last(), std::move(message), std::move(accepted));
    }
  }

  bool read_faces(const PlyElement& element) {
    mesh_.triangles.reserve(rows_to_expect(element));
    // Attributes of a face are those of all of its triangles: a row is read, then stored for each.
    const std::size_t first_attribute = mesh_.attributes.size();
    std::vector<Column> columns(element.properties.size());
    add_attributes(element, true, 1, columns);
    const std::span attributes = std::span(mesh_.attributes).subspan(first_attribute);
    std::vector<Array<float>> values(attributes.size());
    for (const PlyProperty& property : element.properties) faces_.have_texcoords |= is_corner_texcoords(property);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      const std::size_t triangles_before = mesh_.triangles.size();
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        const bool good = is_face_list(property)          ? read_corners(property, row)
                          : is_corner_texcoords(property) ? read_corner_texcoords(property, row)
                                                          : read_property(element, property, columns[i], row);
        if (complaints_.gave_up()) return false;
        if (!good) return ends_early(element, row);
      }
      add_face(row);
      for (std::size_t a = 0; a < attributes.size(); ++a) {
        for (std::size_t i = triangles_before; i < mesh_.triangles.size(); ++i)
          values[a].insert(values[a].end(), attributes[a].values.begin(), attributes[a].values.end());
      }
    }
    for (std::size_t a = 0; a < attributes.size(); ++a) attributes[a].values = std::move(values[a]);
    return true;
  }

  // False at the end of the file.
  bool read_corners(const PlyProperty& property, std::uint64_t row) {
    double count = 0;
    if (!input_.read(*property.count_type, count)) return false;
    if (!(count >= 3)) {
      if (!(count >= 0)) complain(fmt::format("face {} has {} vertices", row, count), "at least 0");
      complaints_.flaw_at(input_.last(), MeshFlaw::small_face,
                          small_face_text(static_cast<std::size_t>(std::max(count, 0.0))));
    }
    faces_.corners.clear();
    for (double i = 0; i < count; ++i) {
      double value = 0;
      if (!input_.read(property.type, value)) return false;
      if (!(value >= 0 && value < static_cast<double>(vertex_count_))) {
        complain(fmt::format("face {} has a vertex {}", row, value),
                 vertex_count_ == 0 ? "no faces: there are no vertices" : fmt::format("0 to {}", vertex_count_ - 1));
        if (complaints_.gave_up()) return false;
        value = 0;
      }
      faces_.corners.push_back(static_cast<std::uint32_t>(value));
    }
    return true;
  }

  // The same.
  bool read_corner_texcoords(const PlyProperty& property, std::uint64_t row) {
    double count = 0, value = 0;
    if (!input_.read(*property.count_type, count)) return false;
    faces_.texcoords.clear();
    for (double i = 0; i < count; ++i) {
      if (!input_.read(property.type, value)) return false;
      if (!(std::abs(value) <= kMaxFloat))
        complaints_.flaw_at(input_.last(), MeshFlaw::not_finite,
                            not_finite_text(fmt::format("a texture coordinate of face {} is {}", row, value)));
      faces_.texcoords.push_back(static_cast<float>(value));
    }
    return true;
  }

  // Puts what was read of a face into the mesh.
  void add_face(std::uint64_t row) {
    const std::size_t corners = faces_.corners.size(), texcoords = faces_.texcoords.size();
    if (texcoords != 0 && texcoords != 2 * corners && corners >= 3) {
      complain(fmt::format("face {} has {} texture coordinates for {} vertices", row, texcoords, corners),
               "two for each, or none");
    }
    if (!complaints_.any()) faces_.add();
  }

  const PlyHeader& header_;
  MeshComplaints& complaints_;
  Input input_;
  MeshData mesh_;
  std::uint64_t vertex_count_ = 0;
  PlyFaces faces_{mesh_};
};

std::optional<MeshData> read_body(const PlyHeader& header, std::string_view bytes, MeshComplaints& complaints) {
  const std::string_view body = bytes.substr(header.size);
  switch (header.format) {
    case PlyFormat::ascii:
      return BodyReader<PlyTextInput>(header, body, complaints).read();
    case PlyFormat::little_endian:
      return BodyReader<PlyBinaryInput<false>>(header, body, complaints).read();
    case PlyFormat::big_endian:
      return BodyReader<PlyBinaryInput<true>>(header, body, complaints).read();
  }
  return std::nullopt;
}

}  // namespace

std::optional<MeshData> read_ply(std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
  MeshComplaints complaints(path, bytes, diagnostics);
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  try {
    const auto header = read_ply_header(bytes, complaints);
    return header ? read_body(*header, bytes, complaints) : std::nullopt;
  } catch (const std::bad_alloc&) {
    complaints.about_file("the mesh does not fit into memory");
    return std::nullopt;
  }
}

}  // namespace norrsken
