// Layout: "OpenEXR File Layout", openexr.com, sections "Header", "Multi-part files" and "Predefined Attribute Types".
#include "image/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>

#include "base/text.h"
#include "image/bytes.h"

namespace norrsken {
namespace {

struct FixedSize {
  std::string_view type;
  std::size_t bytes;
};
constexpr FixedSize kFixedSizes[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};

/// Channels, each a name and 16 bytes, up to one without a name.
bool is_channel_list(Bytes value) {
  constexpr std::size_t kChannelBytes = 16;
  for (;;) {
    const auto name = value.take_word();
    if (!name) return false;
    if (name->empty()) return value.empty();
    if (!value.take(kChannelBytes)) return false;
  }
}

/// Width, height, and four bytes for each pixel.
bool is_preview(Bytes value) {
  const auto width = value.take<std::int32_t>(), height = value.take<std::int32_t>();
  if (!width || !height || *width < 0 || *height < 0) return false;
  return value.size() % 4 == 0 && std::uint64_t(*width) * std::uint64_t(*height) == value.size() / 4;
}

/// Texts, each behind its length.
bool is_string_vector(Bytes value) {
  while (!value.empty()) {
    const auto length = value.take<std::int32_t>();
    if (!length || *length < 0 || !value.take(static_cast<std::size_t>(*length))) return false;
  }
  return true;
}

bool fits(std::string_view type, std::string_view value) {
  const auto* fixed = std::ranges::find(kFixedSizes, type, &FixedSize::type);
  if (fixed != std::end(kFixedSizes)) return value.size() == fixed->bytes;
  if (type == "chlist") return is_channel_list(Bytes(value));
  if (type == "preview") return is_preview(Bytes(value));
  if (type == "stringvector") return is_string_vector(Bytes(value));
  if (type == "floatvector") return value.size() % sizeof(float) == 0;
  if (type == "idmanifest") return false;  // version 3.1 of the library takes 4 bytes more than there are
  return true;                             // read by their size: texts, and types that the library does not know
}

/// What a part decodes at once, from the largest values if an attribute comes twice.
class Block {
 public:
  void look_at(std::string_view name, std::string_view value) {
    Bytes bytes(value);
    if (name == "channels") {
      double sum = 0;
      for (auto channel = bytes.take_word(); channel && !channel->empty(); channel = bytes.take_word()) {
        constexpr std::int32_t kHalf = 1;
        sum += bytes.take<std::int32_t>() == kHalf ? 2 : 4;
        bytes.take(12);
      }
      pixel_bytes_ = std::max(pixel_bytes_, sum);
    } else if (name == "compression") {
      // None, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
      constexpr double kRows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
      const auto kind = bytes.take<std::uint8_t>();
      rows_ = std::max(rows_, kind && *kind < std::size(kRows) ? kRows[*kind] : 1);
    } else if (name == "dataWindow") {
      const auto left = bytes.take<std::int32_t>(), top = bytes.take<std::int32_t>(),
                 right = bytes.take<std::int32_t>();
      if (left && top && right) width_ = std::max(width_, static_cast<double>(*right) - static_cast<double>(*left) + 1);
    } else if (name == "tiles") {
      const auto width = bytes.take<std::uint32_t>(), height = bytes.take<std::uint32_t>();
      if (width && height) tile_ = std::max(tile_, static_cast<double>(*width) * static_cast<double>(*height));
    }
  }
  double bytes() const { return std::max(width_ * rows_, tile_) * pixel_bytes_; }

 private:
  double pixel_bytes_ = 0, rows_ = 1, width_ = 0, tile_ = 0;
};

}  // namespace

std::optional<std::uint64_t> exr_block_bytes(std::string_view file) {
  constexpr std::int32_t kMultipart = 0x1000;
  // Deflate makes at most 1032 bytes of one (zlib's manual).
  const double most_at_once = std::max(double{1 << 26}, 1032 * static_cast<double>(file.size()));
  Bytes bytes(file);
  const auto magic = bytes.take<std::int32_t>(), version = bytes.take<std::int32_t>();
  if (!magic || !version) return std::nullopt;
  // A header ends with an empty name, the headers of several parts with an empty header.
  Block block;
  double most = 0;
  for (bool begins = true; !bytes.empty();) {
    if (bytes.front() == '\0') {
      if (begins || (*version & kMultipart) == 0) return static_cast<std::uint64_t>(most);
      begins = true;
      block = {};
      bytes.take(1);
      continue;
    }
    begins = false;
    const auto name = bytes.take_word();
    if (!name) return std::nullopt;
    const auto type = bytes.take_word();
    const auto size = bytes.take<std::int32_t>();
    if (!type || !size || *size < 0) return std::nullopt;
    const auto value = bytes.take(static_cast<std::size_t>(*size));
    if (!value || !fits(*type, *value)) return std::nullopt;
    block.look_at(*name, *value);
    most = std::max(most, block.bytes());
    if (most > most_at_once) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<ImageHeader> read_exr_header(std::string_view begin) {
  Bytes bytes(begin);
  const auto magic = bytes.take<std::int32_t>(), version = bytes.take<std::int32_t>();
  if (!magic || !version) return std::nullopt;
  ImageHeader header;
  header.format = "EXR";
  while (!bytes.empty()) {
    const auto name = bytes.take_word();
    if (!name) return std::nullopt;
    if (name->empty()) return header.width > 0 && header.height > 0 ? std::optional(header) : std::nullopt;
    const auto type = bytes.take_word();
    const auto size = bytes.take<std::int32_t>();
    if (!type || !size || *size < 0) return std::nullopt;
    const auto text = bytes.take(static_cast<std::size_t>(*size));
    if (!text || !fits(*type, *text)) return std::nullopt;
    Bytes value(*text);
    if (*type == "string") {
      header.metadata[printable(*name)] = printable(*text);
    } else if (*name == "channels" && *type == "chlist") {
      for (auto channel = value.take_word(); channel && !channel->empty(); channel = value.take_word()) {
        header.channels.push_back(printable(*channel));
        value.take(16);
      }
    } else if (*name == "dataWindow" && *type == "box2i") {
      std::int64_t sides[4];
      for (std::int64_t& side : sides) side = value.take<std::int32_t>().value_or(0);
      const std::int64_t width = sides[2] - sides[0] + 1, height = sides[3] - sides[1] + 1;
      constexpr std::int64_t kMost = std::numeric_limits<int>::max();
      if (width < 1 || height < 1 || width > kMost || height > kMost) return std::nullopt;
      header.width = static_cast<int>(width), header.height = static_cast<int>(height);
    }
  }
  return std::nullopt;
}

}  // namespace norrsken
