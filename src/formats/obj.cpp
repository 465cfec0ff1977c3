// Reader for Wavefront OBJ (Appendix B1 of Wavefront's Advanced Visualizer manual): one pass over the bytes, then
// vertices are made of what the faces put together.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>
#include <stdexcept>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/combinations.h"
#include "formats/mesh_complaints.h"
#include "formats/mesh_flaws.h"
#include "formats/mesh_readers.h"
#include "formats/obj_materials.h"
#include "formats/polygon.h"
#include "scene/description.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kAbsent = 0xffffffffu;

// What a face's corner refers to, counted from 0.
struct Corner {
  std::uint32_t position, texcoord, normal;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& path, Diagnostics& diagnostics, ObjMaterials* materials)
      : at_(bytes.data()),
        end_(bytes.data() + bytes.size()),
        complaints_(path, bytes, diagnostics),
        materials_(materials) {}

  std::optional<MeshData> read() {
    skip_byte_order_mark();
    while (at_ < end_ && !complaints_.gave_up()) {
      statement();
      skip_line();
    }
    check_forward_references();
    complaints_.tell_flaws();
    if (corners_.empty() && !complaints_.any())
      complaints_.about_file("the file has no faces", "OBJ text with 'v' and 'f' lines");
    if (complaints_.any()) return std::nullopt;
    for (const Fan& fan : fans_to_come_) cut(fan);
    warn_of_intricate(cutter_, complaints_);
    fill_in_absent();
    MeshData mesh = assemble();
    materials_.give_to(mesh);
    leave_out_not_finite(mesh);
    return mesh;
  }

 private:
  /// A corner's reference to something that the file may still bring.
  struct ForwardReference {
    std::string_view token;
    std::uint32_t index;
    int kind;
  };

  /// The triangles of a face with more than three corners: where in `corners_`, and its corners.
  struct Fan {
    std::size_t first, corners;
  };

  // --- text ---

  void skip_byte_order_mark() {
    if (std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(kByteOrderMark))
      at_ += kByteOrderMark.size();
  }

  // Lines end with LF, CRLF, or CR alone.
  static bool is_break(char c) { return c == '\n' || c == '\r'; }

  // Blanks, and line breaks behind a backslash.
  void skip_blanks() {
    while (at_ < end_) {
      if (*at_ == ' ' || *at_ == '\t') {
        ++at_;
      } else if (*at_ == '\\' && at_ + 1 < end_ && is_break(at_[1])) {
        at_ += at_ + 2 < end_ && at_[1] == '\r' && at_[2] == '\n' ? 3 : 2;
      } else {
        return;
      }
    }
  }

  void skip_line() {
    while (at_ < end_ && !is_break(*at_)) ++at_;
    if (at_ < end_) ++at_;
  }

  bool at_token_end(const char* p) const {
    return p == end_ || *p == ' ' || *p == '\t' || is_break(*p) || *p == '\\' || *p == '#';
  }
  bool at_line_end() const { return at_ == end_ || is_break(*at_) || *at_ == '#'; }

  std::string_view token() const {
    const char* stop = at_;
    while (!at_token_end(stop)) ++stop;
    return {at_, static_cast<std::size_t>(stop - at_)};
  }

  // --- statements ---

  void statement() {
    skip_blanks();
    const std::string_view keyword = token();
    at_ += keyword.size();
    if (keyword == "v") {
      numbers(positions_, keyword, 3, static_cast<float>(kMaxCoordinate));
    } else if (keyword == "vn") {
      numbers(normals_, keyword, 3, std::numeric_limits<float>::max());
    } else if (keyword == "vt") {
      numbers(texcoords_, keyword, 1, std::numeric_limits<float>::max());
    } else if (keyword == "f") {
      face(keyword);
      materials_.note(corners_.size() / 3);
    } else if (materials_.takes(keyword)) {
      materials_.statement(keyword, rest_of_line());
    }
  }

  std::string rest_of_line() const {
    const char* stop = at_;
    while (stop < end_ && !is_break(*stop)) ++stop;
    return std::string(trim({at_, static_cast<std::size_t>(stop - at_)}));
  }

  // As many numbers as an element has, of which `required` must be there; what follows (w, colours) is skipped.
  template <std::size_t Count>
  void numbers(Array<std::array<float, Count>>& into, std::string_view keyword, std::size_t required, float limit) {
    std::array<float, Count> values{};
    for (std::size_t i = 0; i < Count; ++i) {
      skip_blanks();
      if (at_line_end()) {
        if (i < required) complaints_.at(keyword, fmt::format("'{}' has {} numbers", keyword, i), accepted(required));
        break;
      }
      if (!number(values[i], limit)) break;
    }
    into.push_back(values);  // also after a complaint: indices of what follows stay right
  }

  static std::string accepted(std::size_t count) {
    return count == 1 ? "at least one number" : fmt::format("{} numbers", count);
  }

  bool number(float& value, float limit) {
    const char* const first = at_ + (*at_ == '+' && at_ + 1 < end_ && at_[1] != '-' ? 1 : 0);
    const auto [stop, error] = std::from_chars(first, end_, value);
    if (error == std::errc() && at_token_end(stop) && std::abs(value) <= limit) {
      at_ = stop;
      return true;
    }
    // The rare case, once more and in detail.
    const std::string_view word = token();
    NumberStatus status = parse_number(word, value);
    if (status == NumberStatus::ok && std::abs(value) > limit) status = NumberStatus::overflow;
    at_ += word.size();
    if (status == NumberStatus::ok) return true;
    if (status == NumberStatus::not_finite) {
      complaints_.flaw_at(word, MeshFlaw::not_finite, not_finite_text(quoted(word) + " is not finite"));
      value = std::numeric_limits<float>::quiet_NaN();
      return true;
    }
    complaints_.at(word, fmt::format("{} {}", quoted(word), describe(status)),
                   status == NumberStatus::malformed ? "a number such as 1.5 or -2e3"
                                                     : fmt::format("a number from {:g} to {:g}", -limit, limit));
    return false;
  }

  void face(std::string_view keyword) {
    polygon_.clear();
    const std::size_t forward_before = forward_.size();
    for (skip_blanks(); !at_line_end(); skip_blanks()) {
      Corner corner{};
      if (!read_corner(corner)) return;
      polygon_.push_back(corner);
    }
    if (polygon_.size() < 3) {
      complaints_.flaw_at(keyword, MeshFlaw::small_face, small_face_text(polygon_.size()));
      return;
    }
    const Fan fan{corners_.size(), polygon_.size()};
    for (std::size_t i = 2; i < polygon_.size(); ++i) {
      corners_.push_back(polygon_[0]);
      corners_.push_back(polygon_[i - 1]);
      corners_.push_back(polygon_[i]);
    }
    if (polygon_.size() == 3) return;
    if (forward_.size() != forward_before) {
      fans_to_come_.push_back(fan);
    } else {
      cut(fan);
    }
  }

  // Other triangles in place of a fan, if it does not do.
  void cut(const Fan& fan) {
    const auto corner = [&](std::size_t i) -> const Corner& {
      return corners_[fan.first + (i < 2 ? i : 3 * (i - 2) + 2)];
    };
    points_.clear();
    for (std::size_t i = 0; i < fan.corners; ++i) points_.push_back(positions_[corner(i).position]);
    const auto triangles = cutter_.cut(points_);
    if (triangles.empty()) return;
    polygon_.clear();
    for (std::size_t i = 0; i < fan.corners; ++i) polygon_.push_back(corner(i));
    std::size_t at = fan.first;
    for (const PolygonCutter::Triangle& triangle : triangles) {
      for (const std::uint32_t i : triangle) corners_[at++] = polygon_[i];
    }
  }

  // "p", "p/t", "p//n" or "p/t/n".
  bool read_corner(Corner& corner) {
    const std::string_view word = token();
    std::uint32_t* const parts[] = {&corner.position, &corner.texcoord, &corner.normal};
    corner = {kAbsent, kAbsent, kAbsent};
    const char* const stop = word.data() + word.size();
    for (int kind = 0; kind < 3; ++kind) {
      if (at_ != stop && *at_ != '/' && !index(word, kind, stop, *parts[kind])) return false;
      if (at_ == stop) break;
      if (*at_ != '/' || kind == 2) return malformed(word);
      ++at_;
    }
    return corner.position != kAbsent || malformed(word);
  }

  bool malformed(std::string_view word) {
    at_ = word.data() + word.size();
    complaints_.at(word, fmt::format("{} is no vertex of a face", quoted(word)), "p, p/t, p//n or p/t/n with indices");
    return false;
  }

  std::size_t count(int kind) const {
    return kind == 0 ? positions_.size() : kind == 1 ? texcoords_.size() : normals_.size();
  }

  bool index(std::string_view word, int kind, const char* stop, std::uint32_t& result) {
    std::int64_t value = 0;
    const auto [next, error] = std::from_chars(at_, stop, value);
    if (error == std::errc::invalid_argument) return malformed(word);
    const std::string_view digits(at_, static_cast<std::size_t>(next - at_));
    at_ = next;
    const auto known = static_cast<std::int64_t>(count(kind));
    const std::int64_t zero_based = value > 0 ? value - 1 : known + value;
    if (error != std::errc() || value == 0 || zero_based < 0 || zero_based >= kAbsent) {
      out_of_range(digits, kind);
      at_ = word.data() + word.size();
      return false;
    }
    result = static_cast<std::uint32_t>(zero_based);
    if (zero_based >= known) forward_.push_back({digits, result, kind});
    return true;
  }

  void out_of_range(std::string_view digits, int kind) {
    constexpr const char* kKeywords[] = {"v", "vt", "vn"};
    complaints_.at(digits, fmt::format("there is no '{}' number {}", kKeywords[kind], digits),
                   count(kind) == 0 ? fmt::format("no index: there are no '{}' lines", kKeywords[kind])
                                    : fmt::format("1 to {0}, or -{0} to -1 counted back from here", count(kind)));
  }

  // Faces may come before what they are made of.
  void check_forward_references() {
    for (const ForwardReference& reference : forward_) {
      if (complaints_.gave_up()) return;
      if (reference.index >= count(reference.kind)) out_of_range(reference.token, reference.kind);
    }
  }

  // --- assembly ---

  // Where only some corners have a normal or texture coordinates, the others get their triangle's normal and (0, 0).
  void fill_in_absent() {
    const auto has = [this](std::uint32_t Corner::*part) {
      std::size_t present = 0;
      for (const Corner& corner : corners_) present += corner.*part != kAbsent ? 1 : 0;
      return present;
    };
    const std::size_t with_texcoord = has(&Corner::texcoord), with_normal = has(&Corner::normal);
    has_texcoords_ = with_texcoord > 0;
    has_normals_ = with_normal > 0;
    if (has_texcoords_ && with_texcoord < corners_.size()) {
      const auto origin = static_cast<std::uint32_t>(texcoords_.size());
      texcoords_.push_back({0, 0});
      for (Corner& corner : corners_) {
        if (corner.texcoord == kAbsent) corner.texcoord = origin;
      }
    }
    if (!has_normals_ || with_normal == corners_.size()) return;
    for (std::size_t i = 0; i < corners_.size(); i += 3) {
      const auto own = static_cast<std::uint32_t>(normals_.size());
      bool is_used = false;
      for (std::size_t k = i; k < i + 3; ++k) {
        if (corners_[k].normal != kAbsent) continue;
        corners_[k].normal = own;
        is_used = true;
      }
      if (is_used) normals_.push_back(triangle_normal(i));
    }
  }

  std::array<float, 3> triangle_normal(std::size_t first) const {
    const auto position = [&](std::size_t k) {
      const auto& p = positions_[corners_[first + k].position];
      return glm::dvec3(p[0], p[1], p[2]);
    };
    const glm::dvec3 n = glm::cross(position(1) - position(0), position(2) - position(0));
    const double length = glm::length(n);
    const glm::vec3 unit(length > 0 ? n / length : glm::dvec3(0, 0, 1));
    return {unit.x, unit.y, unit.z};
  }

  // Whether every corner has one index for all of its parts, so that the file's vertices can be taken as they are.
  bool is_singly_indexed() const {
    if (has_texcoords_ && texcoords_.size() != positions_.size()) return false;
    if (has_normals_ && normals_.size() != positions_.size()) return false;
    for (const Corner& corner : corners_) {
      if (has_texcoords_ && corner.texcoord != corner.position) return false;
      if (has_normals_ && corner.normal != corner.position) return false;
    }
    return true;
  }

  MeshData assemble() {
    MeshData mesh;
    mesh.triangles.resize(corners_.size() / 3);
    if (is_singly_indexed()) {
      for (std::size_t i = 0; i < corners_.size(); ++i) mesh.triangles[i / 3][i % 3] = corners_[i].position;
      mesh.positions = std::move(positions_);
      if (has_texcoords_) mesh.texcoords = std::move(texcoords_);
      if (has_normals_) mesh.normals = std::move(normals_);
      return mesh;
    }
    // A vertex for every combination of parts.
    Combinations combinations(corners_.size());
    for (std::size_t i = 0; i < corners_.size(); ++i)
      mesh.triangles[i / 3][i % 3] = combinations.number_of(std::bit_cast<Combinations::Key>(corners_[i]));
    const auto& vertices = combinations.keys();
    mesh.positions.reserve(vertices.size());
    if (has_texcoords_) mesh.texcoords.reserve(vertices.size());
    if (has_normals_) mesh.normals.reserve(vertices.size());
    for (const Combinations::Key& key : vertices) {
      const auto vertex = std::bit_cast<Corner>(key);
      mesh.positions.push_back(positions_[vertex.position]);
      if (has_texcoords_) mesh.texcoords.push_back(texcoords_[vertex.texcoord]);
      if (has_normals_) mesh.normals.push_back(normals_[vertex.normal]);
    }
    return mesh;
  }

  const char* at_;
  const char* end_;
  MeshComplaints complaints_;
  ObjMaterialNotes materials_;
  Array<std::array<float, 3>> positions_, normals_;
  Array<std::array<float, 2>> texcoords_;
  Array<Corner> corners_;  ///< three for every triangle
  Array<Corner> polygon_;  ///< of the face being read
  Array<PolygonCutter::Point> points_;
  PolygonCutter cutter_;
  Array<Fan> fans_to_come_;  ///< of faces that came before their vertices
  Array<ForwardReference> forward_;
  bool has_texcoords_ = false, has_normals_ = false;
};

std::optional<MeshData> read(std::string_view bytes, const std::string& path, Diagnostics& diagnostics,
                             ObjMaterials* materials) {
  try {
    return ObjReader(bytes, path, diagnostics, materials).read();
  } catch (const std::bad_alloc&) {
    MeshComplaints(path, bytes, diagnostics).about_file("the mesh does not fit into memory");
    return std::nullopt;
  }
}

}  // namespace

std::optional<MeshData> read_obj(std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
  return read(bytes, path, diagnostics, nullptr);
}

std::optional<MeshData> read_obj_with_materials(std::string_view bytes, const std::string& path,
                                                Diagnostics& diagnostics, ObjMaterials& materials) {
  return read(bytes, path, diagnostics, &materials);
}

}  // namespace norrsken
