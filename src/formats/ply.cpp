// Reader for Stanford PLY (Turk 1994): the header says which values follow each other, the body is read in one pass.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/mesh_complaints.h"
#include "formats/mesh_readers.h"
#include "formats/ply_header.h"
#include "scene/description.h"

namespace norrsken {
namespace {

static_assert(std::endian::native == std::endian::little, "byte order is swapped for big-endian files only");

template <typename T, bool Swap>
double load(const char* bytes) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if constexpr (Swap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

// Values of a binary body, one after the other.
template <bool Swap>
class BinaryInput {
 public:
  BinaryInput(std::string_view body, MeshComplaints&) : at_(body.data()), end_(body.data() + body.size()) {}

  /// False at the end of the file.
  bool read(PlyType type, double& value) {
    if (remaining() < size_of(type)) return false;
    switch (type) {
      case PlyType::int8:
        value = load<std::int8_t, Swap>(at_);
        break;
      case PlyType::uint8:
        value = load<std::uint8_t, Swap>(at_);
        break;
      case PlyType::int16:
        value = load<std::int16_t, Swap>(at_);
        break;
      case PlyType::uint16:
        value = load<std::uint16_t, Swap>(at_);
        break;
      case PlyType::int32:
        value = load<std::int32_t, Swap>(at_);
        break;
      case PlyType::uint32:
        value = load<std::uint32_t, Swap>(at_);
        break;
      case PlyType::float32:
        value = load<float, Swap>(at_);
        break;
      case PlyType::float64:
        value = load<double, Swap>(at_);
        break;
    }
    at_ += size_of(type);
    return true;
  }

  bool failed() const { return false; }
  std::string_view last() const { return {}; }
  /// The fewest bytes that a value of the type can take.
  static std::size_t least_size(PlyType type) { return size_of(type); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  const char* at_;
  const char* end_;
};

// Values of a body of text, apart by blanks and line breaks.
class TextInput {
 public:
  TextInput(std::string_view body, MeshComplaints& complaints) : body_(body), complaints_(complaints) {}

  /// False at the end of the file, or after a complaint: then `failed`.
  bool read(PlyType type, double& value) {
    at_ = std::min(body_.find_first_not_of(kBlanks, at_), body_.size());
    if (at_ == body_.size()) return false;
    const std::size_t stop = std::min(body_.find_first_of(kBlanks, at_), body_.size());
    last_ = body_.substr(at_, stop - at_);
    at_ = stop;
    NumberStatus status = parse_number(last_, value);
    // "nan" is for whoever asked for the value to judge; it may be a property that nobody asks for.
    if (status == NumberStatus::not_finite || status == NumberStatus::overflow) {
      value = std::numeric_limits<double>::quiet_NaN();
      status = NumberStatus::ok;
    }
    const bool fits = type >= PlyType::float32 || std::isnan(value) || value == std::floor(value);
    if (status == NumberStatus::ok && fits) return true;
    failed_ = true;
    complaints_.at(last_, fmt::format("{} is no {}", quoted(last_), type >= PlyType::float32 ? "number" : "integer"),
                   "values as the header says");
    return false;
  }

  bool failed() const { return failed_; }
  /// The word that was read last.
  std::string_view last() const { return last_; }
  static std::size_t least_size(PlyType) { return 2; }
  std::size_t remaining() const { return body_.size() - at_; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\n";

  std::string_view body_;
  MeshComplaints& complaints_;
  std::size_t at_ = 0;
  std::string_view last_;
  bool failed_ = false;
};

// What a vertex may have, in the order of the values of a row.
enum Slot { kX, kY, kZ, kNx, kNy, kNz, kU, kV, kSlots };

int slot_of(std::string_view property) {
  constexpr std::pair<std::string_view, Slot> kNames[] = {
      {"x", kX}, {"y", kY}, {"z", kZ}, {"nx", kNx}, {"ny", kNy},       {"nz", kNz},
      {"u", kU}, {"v", kV}, {"s", kU}, {"t", kV},   {"texture_u", kU}, {"texture_v", kV}};
  for (const auto& [name, slot] : kNames) {
    if (name == property) return slot;
  }
  return kSlots;
}

bool is_face_list(const PlyProperty& property) {
  return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

template <typename Input>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, std::string_view body, MeshComplaints& complaints)
      : header_(header), complaints_(complaints), input_(body, complaints) {}

  std::optional<MeshData> read() {
    const PlyElement* vertices = find("vertex");
    const PlyElement* faces = find("face");
    if (!vertices || !faces || !check(*vertices, *faces)) {
      if (!complaints_.any())
        complaints_.about_file("the mesh has no vertices or no faces", "elements 'vertex' and 'face'");
      return std::nullopt;
    }
    vertex_count_ = vertices->count;
    for (const PlyElement& element : header_.elements) {
      const bool good = &element == vertices ? read_vertices(element)
                        : &element == faces  ? read_faces(element)
                                             : skip(element);
      if (!good) return std::nullopt;
      if (!mesh_.positions.empty() && !mesh_.triangles.empty()) break;
    }
    if (mesh_.triangles.empty() && !complaints_.any()) complaints_.about_file("the mesh has no faces", "at least one");
    return complaints_.any() ? std::nullopt : std::optional(std::move(mesh_));
  }

 private:
  const PlyElement* find(std::string_view name) const {
    const auto named = [name](const PlyElement& element) { return element.name == name; };
    const auto found = std::find_if(header_.elements.begin(), header_.elements.end(), named);
    return found == header_.elements.end() ? nullptr : &*found;
  }

  bool check(const PlyElement& vertices, const PlyElement& faces) {
    for (const PlyProperty& property : vertices.properties) {
      if (!property.count_type) has_[slot_of(property.name)] = true;
    }
    if (!has_[kX] || !has_[kY] || !has_[kZ]) {
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

  bool ends_early(const PlyElement& element, std::uint64_t row) {
    if (!input_.failed())
      complaints_.about_file(
          fmt::format("the file ends in element '{}' {} of {}", element.name, row + 1, element.count),
          "as many as the header says");
    return false;
  }

  // A count is believed as far as there are bytes for it.
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
    double ignored = 0;
    if (element.properties.empty()) return true;
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (const PlyProperty& property : element.properties) {
        if (!(property.count_type ? skip_list(property) : input_.read(property.type, ignored)))
          return ends_early(element, row);
      }
    }
    return true;
  }

  bool read_vertices(const PlyElement& element) {
    const bool has_normals = has_[kNx] && has_[kNy] && has_[kNz], has_texcoords = has_[kU] && has_[kV];
    const std::size_t expected = rows_to_expect(element);
    mesh_.positions.reserve(expected);
    if (has_normals) mesh_.normals.reserve(expected);
    if (has_texcoords) mesh_.texcoords.reserve(expected);
    std::vector<int> slots;
    for (const PlyProperty& property : element.properties) slots.push_back(slot_of(property.name));

    std::array<float, kSlots + 1> values{};
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (std::size_t i = 0; i < slots.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        double value = 0;
        if (property.count_type) {
          if (!skip_list(property)) return ends_early(element, row);
          continue;
        }
        if (!input_.read(property.type, value)) return ends_early(element, row);
        const double limit = slots[i] <= kZ ? kMaxCoordinate : std::numeric_limits<float>::max();
        if (slots[i] != kSlots && !(std::abs(value) <= limit)) {
          value_out_of_range(property, row, value, limit);
          if (complaints_.gave_up()) return false;
          value = 0;
        }
        values[static_cast<std::size_t>(slots[i])] = slots[i] == kSlots ? 0.0f : static_cast<float>(value);
      }
      mesh_.positions.push_back({values[kX], values[kY], values[kZ]});
      if (has_normals) mesh_.normals.push_back({values[kNx], values[kNy], values[kNz]});
      if (has_texcoords) mesh_.texcoords.push_back({values[kU], values[kV]});
    }
    return true;
  }

  void value_out_of_range(const PlyProperty& property, std::uint64_t row, double value, double limit) {
    complain(fmt::format("'{}' of vertex {} is {}", property.name, row,
                         input_.last().empty() ? fmt::format("{}", value) : std::string(input_.last())),
             fmt::format("a number from {:g} to {:g}", -limit, limit));
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
    double ignored = 0;
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (const PlyProperty& property : element.properties) {
        const bool good = is_face_list(property) ? read_face(property, row)
                          : property.count_type  ? skip_list(property)
                                                 : input_.read(property.type, ignored);
        if (complaints_.gave_up()) return false;
        if (!good) return ends_early(element, row);
      }
    }
    return true;
  }

  // A fan around the first corner. False at the end of the file.
  bool read_face(const PlyProperty& property, std::uint64_t row) {
    double count = 0;
    if (!input_.read(*property.count_type, count)) return false;
    if (!(count >= 3)) complain(fmt::format("face {} has {} vertices", row, count), "at least 3 vertices");
    std::uint32_t first = 0, previous = 0;
    for (double i = 0; i < count; ++i) {
      double value = 0;
      if (!input_.read(property.type, value)) return false;
      if (!(value >= 0 && value < static_cast<double>(vertex_count_))) {
        complain(fmt::format("face {} has a vertex {}", row, value),
                 vertex_count_ == 0 ? "no faces: there are no vertices" : fmt::format("0 to {}", vertex_count_ - 1));
        if (complaints_.gave_up()) return false;
        value = 0;
      }
      const auto index = static_cast<std::uint32_t>(value);
      if (i == 0) first = index;
      if (i >= 2) mesh_.triangles.push_back({first, previous, index});
      previous = index;
    }
    return true;
  }

  const PlyHeader& header_;
  MeshComplaints& complaints_;
  Input input_;
  MeshData mesh_;
  std::array<bool, kSlots + 1> has_{};
  std::uint64_t vertex_count_ = 0;
};

std::optional<MeshData> read_body(const PlyHeader& header, std::string_view bytes, MeshComplaints& complaints) {
  const std::string_view body = bytes.substr(header.size);
  switch (header.format) {
    case PlyFormat::ascii:
      return BodyReader<TextInput>(header, body, complaints).read();
    case PlyFormat::little_endian:
      return BodyReader<BinaryInput<false>>(header, body, complaints).read();
    case PlyFormat::big_endian:
      return BodyReader<BinaryInput<true>>(header, body, complaints).read();
  }
  return std::nullopt;
}

}  // namespace

std::optional<MeshData> read_ply(std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
  MeshComplaints complaints(path, bytes, diagnostics);
  try {
    const auto header = read_ply_header(bytes, complaints);
    return header ? read_body(*header, bytes, complaints) : std::nullopt;
  } catch (const std::bad_alloc&) {
    complaints.about_file("the mesh does not fit into memory");
    return std::nullopt;
  }
}

}  // namespace norrsken
