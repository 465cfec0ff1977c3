// Reader for STL (3D Systems, "StereoLithography Interface Specification", 1989): text or binary.
#include <fmt/format.h>

#include <bit>
#include <new>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/mesh_complaints.h"
#include "formats/mesh_flaws.h"
#include "formats/mesh_readers.h"
#include "scene/description.h"

namespace norrsken {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;
constexpr std::string_view kBlanks = " \t\r\n\f\v";

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t k = 4; k-- > 0;) word = word << 8u | static_cast<unsigned char>(bytes[offset + k]);
  return word;
}

class StlReader {
 public:
  StlReader(std::string_view bytes, const std::string& path, Diagnostics& diagnostics)
      : bytes_(bytes), complaints_(path, bytes, diagnostics) {}

  std::optional<MeshData> read() {
    // The word "solid" may begin a binary file, too: its length tells.
    const bool has_header = bytes_.size() >= kHeaderBytes;
    const std::uint64_t facets = has_header ? word_at(bytes_, kHeaderBytes - 4) : 0;
    const std::uint64_t told = kHeaderBytes + kFacetBytes * facets;
    if (has_header && (told == bytes_.size() || !is_text())) {
      read_binary(facets, told);
    } else if (is_text()) {
      read_text();
    } else {
      complaints_.about_file("the file is no STL",
                             "text that begins with 'solid', or a header of 84 bytes and facets of 50");
    }
    complaints_.tell_flaws();
    if (mesh_.triangles.empty() && !complaints_.any())
      complaints_.about_file("the file has no facets", "facets of three vertices");
    if (complaints_.any()) return std::nullopt;
    mesh_.face_normals = true;
    leave_out_not_finite(mesh_);
    return std::move(mesh_);
  }

 private:
  bool is_text() const {
    return trim(bytes_.substr(0, 256)).starts_with("solid") &&
           bytes_.substr(0, 1024).find('\0') == std::string_view::npos;
  }

  void add(const std::array<float, 3>& position) {
    std::array<float, 3> p = position;
    for (float& x : p) {
      if (std::abs(x) < static_cast<float>(kMaxCoordinate)) continue;
      complaints_.flaw_at({}, MeshFlaw::not_finite, not_finite_text("a coordinate is not finite or too large"));
      x = std::numeric_limits<float>::quiet_NaN();
    }
    mesh_.positions.push_back(p);
    const auto count = static_cast<std::uint32_t>(mesh_.positions.size());
    if (count % 3 == 0) mesh_.triangles.push_back({count - 3, count - 2, count - 1});
  }

  void read_binary(std::uint64_t facets, std::uint64_t told) {
    if (told > bytes_.size())
      return complaints_.about_file(
          fmt::format("the file is cut off: {} facets take {} bytes, it has {}", facets, told, bytes_.size()),
          "a whole file");
    mesh_.positions.reserve(3 * facets);
    mesh_.triangles.reserve(facets);
    for (std::uint64_t i = 0; i < facets; ++i) {
      const std::size_t first = kHeaderBytes + kFacetBytes * i + 12;  // behind the normal
      for (std::size_t k = 0; k < 3; ++k) {
        const auto coordinate = [&](std::size_t c) {
          return std::bit_cast<float>(word_at(bytes_, first + 12 * k + 4 * c));
        };
        add({coordinate(0), coordinate(1), coordinate(2)});
      }
    }
  }

  /// Empty at the end.
  std::string_view next_word() {
    const std::size_t begin = bytes_.find_first_not_of(kBlanks, at_);
    if (begin == std::string_view::npos) return {};
    at_ = std::min(bytes_.find_first_of(kBlanks, begin), bytes_.size());
    return bytes_.substr(begin, at_ - begin);
  }

  void read_text() {
    std::size_t in_facet = 0;
    for (std::string_view word = next_word(); !word.empty() && !complaints_.gave_up(); word = next_word()) {
      if (word == "solid" || word == "endsolid") {
        at_ = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
      } else if (word == "vertex") {
        read_vertex(word);
        if (++in_facet > 3) complaints_.at(word, "a facet has more than three vertices", "three");
      } else if (word == "endfacet") {
        if (in_facet < 3) complaints_.at(word, fmt::format("a facet has {} vertices", in_facet), "three");
        in_facet = 0;
      }
    }
    if (in_facet != 0 && !complaints_.any()) complaints_.about_file("the file ends inside of a facet", "endfacet");
  }

  void read_vertex(std::string_view keyword) {
    std::array<float, 3> position{};
    for (float& x : position) {
      const std::string_view word = next_word();
      const NumberStatus status = parse_number(word, x);
      if (status == NumberStatus::not_finite || status == NumberStatus::overflow) {
        x = std::numeric_limits<float>::quiet_NaN();
      } else if (status != NumberStatus::ok) {
        return complaints_.at(word.empty() ? keyword : word, fmt::format("{} {}", quoted(word), describe(status)),
                              "a number");
      }
    }
    add(position);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  MeshComplaints complaints_;
  MeshData mesh_;
};

}  // namespace

std::optional<MeshData> read_stl(std::string_view bytes, const std::string& path, Diagnostics& diagnostics) {
  try {
    return StlReader(bytes, path, diagnostics).read();
  } catch (const std::bad_alloc&) {
    MeshComplaints(path, bytes, diagnostics).about_file("the mesh does not fit into memory");
    return std::nullopt;
  }
}

}  // namespace norrsken
