#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <utility>
#include <vector>

#include "image/bytes.h"
#include "image/raster_image.h"
#include "image/size.h"

namespace norrsken {
namespace {

using Color = std::array<std::uint8_t, 3>;

/// Where a channel is in a pixel's 16 or 32 bits.
struct Mask {
  std::uint32_t bits = 0;

  bool is_contiguous() const { return bits == 0 || std::has_single_bit(std::uint64_t{most()} + 1); }
  std::uint32_t most() const { return bits == 0 ? 0 : bits >> std::countr_zero(bits); }
  std::uint8_t of(std::uint32_t pixel) const {
    return bits == 0 ? std::uint8_t{0} : scaled_integer<std::uint8_t>((pixel & bits) >> std::countr_zero(bits), most());
  }
};

struct Header {
  std::uint32_t pixels_at = 0;
  std::int64_t width = 0, height = 0;  ///< negative heights: top row first
  int bits = 0;
  bool is_encoded = false;     ///< in runs, of 4 and 8 bits
  std::array<Mask, 4> masks;   ///< red, green, blue, alpha of 16 and 32 bits
  std::vector<Color> palette;  ///< of 1, 4 and 8 bits

  int count_channels() const {
    if (bits > 8) return masks[3].bits != 0 ? 4 : 3;
    return std::ranges::all_of(palette, [](const Color& c) { return c[0] == c[1] && c[1] == c[2]; }) ? 1 : 3;
  }
  std::uint64_t row_bytes() const { return (static_cast<std::uint64_t>(width) * bits + 31) / 32 * 4; }
};

/// The fields of a header that is there in full, and what follows it.
struct HeaderBytes {
  std::string_view fields;
  Bytes behind;

  template <class T>
  T at(std::size_t offset) const {
    return *Bytes(fields.substr(offset)).take<T>();
  }
};

// Bytes of the headers: BITMAPCOREHEADER, of OS/2, BITMAPINFOHEADER, and one that goes on with four masks.
constexpr std::uint32_t kCoreBytes = 12, kInfoBytes = 40, kAlphaMaskBytes = 56;

std::string read_masks(HeaderBytes& bytes, bool alpha, Header& header) {
  const std::size_t count = alpha || bytes.fields.size() >= kAlphaMaskBytes ? 4 : 3;
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t offset = kInfoBytes + 4 * c;
    const auto mask =
        bytes.fields.size() >= offset + 4 ? bytes.at<std::uint32_t>(offset) : bytes.behind.take<std::uint32_t>();
    if (!mask) return "its header is cut off";
    header.masks[c] = {*mask};
    if (!header.masks[c].is_contiguous()) return "the bits of its channels are not next to each other";
  }
  return {};
}

std::string read_palette(Bytes bytes, std::uint32_t count, int bytes_per_color, Header& header) {
  // Where the pixels begin it ends, whatever the header says.
  while (header.palette.size() < count) {
    const auto color = bytes.take(bytes_per_color);
    if (!color) break;
    const auto channel = [&](int c) { return static_cast<std::uint8_t>((*color)[c]); };
    header.palette.push_back({channel(2), channel(1), channel(0)});
  }
  return header.palette.empty() ? "it has no palette" : "";
}

/// The compression that BITMAPINFOHEADER and its successors tell, and the palette.
std::string read_info(HeaderBytes& bytes, Header& header) {
  constexpr std::uint32_t kUncompressed = 0, kRuns8 = 1, kRuns4 = 2, kBitFields = 3, kAlphaBitFields = 6;
  const auto compression = bytes.at<std::uint32_t>(16), colors = bytes.at<std::uint32_t>(32);
  const bool has_masks = compression == kBitFields || compression == kAlphaBitFields;
  header.is_encoded = compression == (header.bits == 8 ? kRuns8 : kRuns4) && (header.bits == 8 || header.bits == 4);
  const bool is_masked = has_masks && (header.bits == 16 || header.bits == 32);
  if (compression != kUncompressed && !header.is_encoded && !is_masked) {
    return "its " + std::to_string(header.bits) + " bits a pixel are compressed in way " + std::to_string(compression) +
           ", accepted are 0 (not), 1 for 8 bits, 2 for 4 bits, and 3 and 6 for 16 and 32 bits";
  }
  if (header.bits > 8) return has_masks ? read_masks(bytes, compression == kAlphaBitFields, header) : std::string{};
  if (colors > 1u << header.bits) {
    return "it has a palette of " + std::to_string(colors) + " colours, accepted are " +
           std::to_string(1 << header.bits);
  }
  return read_palette(bytes.behind, colors == 0 ? 1u << header.bits : colors, 4, header);
}

std::string read_header(std::string_view contents, Header& header) {
  constexpr std::size_t kPixelsAt = 10, kFileHeaderBytes = 14;
  const auto pixels_at = Bytes(contents.substr(std::min(kPixelsAt, contents.size()))).take<std::uint32_t>();
  if (!pixels_at) return "its header is cut off";
  const std::string_view before_pixels = contents.substr(0, std::max<std::size_t>(*pixels_at, kFileHeaderBytes));
  const std::string_view here = before_pixels.substr(kFileHeaderBytes);
  Bytes behind(here);
  const auto header_bytes = behind.take<std::uint32_t>();
  const char* const cut_off =
      before_pixels.size() < contents.size() ? "its pixels begin within its header" : "its header is cut off";
  if (!header_bytes) return cut_off;
  if (*header_bytes != kCoreBytes && *header_bytes < kInfoBytes) {
    return "its header has " + std::to_string(*header_bytes) + " bytes, accepted are 12 and from 40 on";
  }
  if (!behind.take(*header_bytes - sizeof(std::uint32_t))) return cut_off;
  HeaderBytes bytes{here.substr(0, *header_bytes), behind};
  const bool is_core = *header_bytes == kCoreBytes;
  header.pixels_at = *pixels_at;
  header.width = is_core ? bytes.at<std::uint16_t>(4) : bytes.at<std::int32_t>(4);
  header.height = is_core ? bytes.at<std::uint16_t>(6) : bytes.at<std::int32_t>(8);
  header.bits = bytes.at<std::uint16_t>(is_core ? 10 : 14);
  constexpr int kAccepted[] = {1, 4, 8, 16, 24, 32};
  if (std::ranges::find(kAccepted, header.bits) == std::end(kAccepted)) {
    return "it has " + std::to_string(header.bits) + " bits a pixel, accepted are 1, 4, 8, 16, 24 and 32";
  }
  if (header.bits == 16) header.masks = {Mask{0x7c00}, Mask{0x03e0}, Mask{0x001f}};
  if (header.bits == 32) header.masks = {Mask{0xff0000}, Mask{0x00ff00}, Mask{0x0000ff}};
  if (!is_core) return read_info(bytes, header);
  return header.bits <= 8 ? read_palette(behind, 1u << header.bits, 3, header) : std::string{};
}

/// Appends the pixels of a row. False if one has a colour that the palette has not.
bool append_row(const Header& header, int channels, const std::uint8_t* row, Array<std::uint8_t>& bytes) {
  for (std::int64_t x = 0; x < header.width; ++x) {
    if (header.bits == 24) {
      bytes.insert(bytes.end(), {row[3 * x + 2], row[3 * x + 1], row[3 * x]});
    } else if (header.bits > 8) {
      std::uint32_t pixel = 0;
      for (int b = header.bits / 8; b-- > 0;) pixel = pixel << 8 | row[x * (header.bits / 8) + b];
      for (int c = 0; c < channels; ++c) bytes.push_back(header.masks[c].of(pixel));
    } else {
      const std::int64_t bit = x * header.bits;
      const int index = row[bit / 8] >> (8 - header.bits - bit % 8) & ((1 << header.bits) - 1);
      if (static_cast<std::size_t>(index) >= header.palette.size()) return false;
      bytes.insert(bytes.end(), header.palette[index].begin(), header.palette[index].begin() + channels);
    }
  }
  return true;
}

/// A palette's indices, which begin as zeros, and where the next one goes: the bottom row first, each from its left.
class Indices {
 public:
  Indices(std::int64_t width, std::int64_t height)
      : width_(width), height_(height), values_(static_cast<std::size_t>(width * height)) {}

  bool is_full() const { return y_ >= height_; }
  bool is_complete() const { return is_full() || (y_ == height_ - 1 && x_ >= width_); }
  void put(int value) {
    if (x_ < width_) values_[static_cast<std::size_t>(y_ * width_ + x_)] = static_cast<std::uint8_t>(value);
    ++x_;
  }
  void move(int right, int up) { x_ += right, y_ += up; }
  void end_row() { x_ = 0, ++y_; }
  Array<std::uint8_t> take() { return std::move(values_); }

 private:
  std::int64_t width_, height_, x_ = 0, y_ = 0;
  Array<std::uint8_t> values_;
};

/// Reads indices that are stored in runs; of 4 bits two in turn. False if they are cut off or go beyond the last row.
bool read_runs(Bytes data, int bits, Indices& indices) {
  enum Escape { kEndOfRow = 0, kEndOfImage = 1, kMove = 2 };
  const auto nth = [&](const std::uint8_t* bytes, int i) {
    return bits == 8 ? bytes[i] : bytes[i / 2] >> (i % 2 == 0 ? 4 : 0) & 15;
  };
  for (;;) {
    const auto count = data.take<std::uint8_t>(), value = data.take<std::uint8_t>();
    if (!count || !value) return indices.is_complete();  // some leave the mark of the end out
    if (*count == 0 && *value == kEndOfImage) return true;
    if (indices.is_full()) return false;
    if (*count > 0) {
      const std::uint8_t both[2] = {*value, *value};
      for (int i = 0; i < *count; ++i) indices.put(nth(both, i % 2));
    } else if (*value == kEndOfRow) {
      indices.end_row();
    } else if (*value == kMove) {
      const auto right = data.take<std::uint8_t>(), up = data.take<std::uint8_t>();
      if (!right || !up) return false;
      indices.move(*right, *up);
    } else {
      // As they are, in whole words.
      const auto stored = data.take(static_cast<std::size_t>((*value * bits + 15) / 16 * 2));
      if (!stored) return false;
      for (int i = 0; i < *value; ++i) indices.put(nth(reinterpret_cast<const std::uint8_t*>(stored->data()), i));
    }
  }
}

}  // namespace

bool is_bmp(std::string_view contents) { return contents.starts_with("BM"); }

std::string read_bmp(std::string_view contents, RasterImage& image) {
  Header header;
  if (std::string error = read_header(contents, header); !error.empty()) return error;
  const std::int64_t height = std::abs(header.height);
  if (header.width < 1 || height < 1) return "it has no pixels";
  const int channels = header.count_channels();
  if (static_cast<std::uint64_t>(header.width) > kMostImageValues / (static_cast<std::uint64_t>(height) * channels)) {
    return too_many_values(size_text(header.width, height) + " pixels", channels);
  }
  // Runs may leave out as much as they like, which none does.
  if (!may_hold(static_cast<std::uint64_t>(header.width * height), contents.size())) {
    return does_not_fit(header.width, height, contents.size());
  }
  const std::string_view data = contents.substr(std::min<std::size_t>(header.pixels_at, contents.size()));
  const auto* pixels = reinterpret_cast<const std::uint8_t*>(data.data());
  Array<std::uint8_t> indices;
  if (header.is_encoded) {
    Indices reader(header.width, height);
    if (!read_runs(Bytes(data), header.bits, reader)) return "its pixels are cut off, or more than it has room for";
    indices = reader.take();
    pixels = indices.data();
    header.bits = 8;
  }
  const std::uint64_t row_bytes = header.is_encoded ? header.width : header.row_bytes();
  // The last row's padding may be missing.
  const std::uint64_t used = (static_cast<std::uint64_t>(header.width) * header.bits + 7) / 8;
  if (!header.is_encoded &&
      (used > data.size() || (data.size() - used) / row_bytes < static_cast<std::uint64_t>(height - 1))) {
    return does_not_fit(header.width, height, contents.size());
  }
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(height);
  image.channels = channels;
  image.bytes.reserve(static_cast<std::size_t>(header.width * height * image.channels));
  for (std::int64_t y = 0; y < height; ++y) {
    const std::int64_t stored = header.height < 0 ? y : height - 1 - y;
    if (!append_row(header, channels, pixels + stored * row_bytes, image.bytes)) return kNotInPalette;
  }
  return {};
}

}  // namespace norrsken
