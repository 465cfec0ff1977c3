#include "formats/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/numbers.h"
#include "base/text.h"

namespace norrsken {
namespace {

// A line of a header is words; nobody writes longer ones, and a binary file without line breaks is no header.
constexpr std::size_t kMaxLine = 4096;
constexpr std::size_t kMaxWordsTotal = 10000;

constexpr std::pair<std::string_view, PlyType> kTypes[] = {
    {"char", PlyType::int8},      {"uchar", PlyType::uint8},    {"short", PlyType::int16},
    {"ushort", PlyType::uint16},  {"int", PlyType::int32},      {"uint", PlyType::uint32},
    {"float", PlyType::float32},  {"double", PlyType::float64}, {"int8", PlyType::int8},
    {"uint8", PlyType::uint8},    {"int16", PlyType::int16},    {"uint16", PlyType::uint16},
    {"int32", PlyType::int32},    {"uint32", PlyType::uint32},  {"float32", PlyType::float32},
    {"float64", PlyType::float64}};

constexpr std::pair<std::string_view, PlyFormat> kFormats[] = {{"ascii", PlyFormat::ascii},
                                                               {"binary_little_endian", PlyFormat::little_endian},
                                                               {"binary_big_endian", PlyFormat::big_endian}};

template <typename Table>
std::vector<std::string> names_of(const Table& table) {
  std::vector<std::string> names;
  for (const auto& [name, value] : table) names.emplace_back(name);
  return names;
}

template <typename Table>
auto find(const Table& table, std::string_view word) -> std::optional<decltype(std::begin(table)->second)> {
  for (const auto& [name, value] : table) {
    if (name == word) return value;
  }
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, MeshComplaints& complaints) : bytes_(bytes), complaints_(complaints) {}

  std::optional<PlyHeader> read() {
    if (!bytes_.starts_with("ply\n") && !bytes_.starts_with("ply\r")) {
      complaints_.about_file("this is no PLY file", "a file whose first line is 'ply'");
      return std::nullopt;
    }
    next_line();
    while (next_line()) {
      if (words_.empty()) continue;
      const std::string_view keyword = words_[0];
      if (keyword == "end_header") return finish();
      if (keyword == "comment" || keyword == "obj_info") continue;
      if (!(keyword == "format"     ? format()
            : keyword == "element"  ? element()
            : keyword == "property" ? property()
                                    : unknown()))
        return std::nullopt;
    }
    complaints_.about_file("the header has no end", "a line 'end_header'");
    return std::nullopt;
  }

 private:
  bool next_line() {
    if (at_ >= bytes_.size() || word_count_ > kMaxWordsTotal) return false;
    const std::size_t end = bytes_.substr(at_, kMaxLine).find_first_of("\r\n");
    if (end == std::string_view::npos) return false;
    line_ = bytes_.substr(at_, end);
    at_ += end;
    at_ += bytes_.substr(at_).starts_with("\r\n") ? 2 : 1;
    words_.clear();
    for (std::size_t i = 0; (i = line_.find_first_not_of(" \t", i)) != std::string_view::npos;) {
      const std::size_t stop = std::min(line_.find_first_of(" \t", i), line_.size());
      words_.push_back(line_.substr(i, stop - i));
      i = stop;
    }
    word_count_ += words_.size() + 1;
    return true;
  }

  bool complain(std::string_view piece, std::string message, std::string accepted) {
    complaints_.at(piece, std::move(message), std::move(accepted));
    return false;
  }

  bool unknown() {
    return complain(words_[0], fmt::format("unknown keyword {}", quoted(words_[0])),
                    "comment, element, end_header, format, obj_info, property");
  }

  bool format() {
    if (words_.size() != 3) return complain(line_, "'format' has two words", "format ascii 1.0");
    const auto known = find(kFormats, words_[1]);
    if (!known)
      return complain(words_[1], fmt::format("unknown format {}", quoted(words_[1])), join(names_of(kFormats)));
    if (words_[2] != "1.0") return complain(words_[2], fmt::format("version {}", quoted(words_[2])), "1.0");
    header_.format = *known;
    has_format_ = true;
    return true;
  }

  bool element() {
    std::int64_t count = 0;
    if (words_.size() != 3) return complain(line_, "'element' has a name and a count", "element vertex 8");
    if (parse_integer(words_[2], count) != NumberStatus::ok || count < 0)
      return complain(words_[2], fmt::format("{} is no count", quoted(words_[2])), "an integer of at least 0");
    header_.elements.push_back({std::string(words_[1]), static_cast<std::uint64_t>(count), {}});
    return true;
  }

  bool property() {
    if (header_.elements.empty()) return complain(line_, "a property before any element", "an 'element' line first");
    const bool is_list = words_.size() > 1 && words_[1] == "list";
    if (words_.size() != (is_list ? 5u : 3u))
      return complain(line_, "a property has a type and a name",
                      "property float x, property list uchar int vertex_indices");
    PlyProperty property;
    property.name = words_.back();
    const std::string_view type_word = words_[words_.size() - 2];
    const auto type = find(kTypes, type_word);
    if (!type) return complain(type_word, fmt::format("unknown type {}", quoted(type_word)), join(names_of(kTypes)));
    property.type = *type;
    if (is_list) {
      property.count_type = find(kTypes, words_[2]);
      const bool is_integer = property.count_type && *property.count_type < PlyType::float32;
      if (!is_integer)
        return complain(words_[2], fmt::format("{} is no type of a count", quoted(words_[2])), "an integer type");
    }
    header_.elements.back().properties.push_back(std::move(property));
    return true;
  }

  std::optional<PlyHeader> finish() {
    if (!has_format_) {
      complaints_.about_file("the header has no format", "a line 'format ascii 1.0' or the like");
      return std::nullopt;
    }
    header_.size = at_;
    return std::move(header_);
  }

  std::string_view bytes_;
  MeshComplaints& complaints_;
  PlyHeader header_;
  std::size_t at_ = 0;
  std::string_view line_;
  std::vector<std::string_view> words_;
  std::size_t word_count_ = 0;
  bool has_format_ = false;
};

}  // namespace

std::optional<PlyHeader> read_ply_header(std::string_view bytes, MeshComplaints& complaints) {
  return HeaderReader(bytes, complaints).read();
}

}  // namespace norrsken
