#include <algorithm>
#include <cstdint>
#include <optional>

#include "image/bytes.h"
#include "image/raster_image.h"
#include "image/size.h"

namespace norrsken {
namespace {

enum class Kind { palette = 1, color = 2, grey = 3 };

/// The fields of the file's first 18 bytes.
struct Header {
  static constexpr std::size_t kBytes = 18;
  int id_bytes = 0, has_palette = 0, type = 0;
  int palette_first = 0, palette_length = 0, palette_bits = 0;
  int width = 0, height = 0, bits = 0, descriptor = 0;

  bool is_encoded() const { return (type & 8) != 0; }
  Kind kind() const { return static_cast<Kind>(type & 7); }
  /// Bytes of a stored pixel, and of a colour of the palette. 15 bits are 16 of which one is not used.
  int pixel_bytes() const { return (bits + 7) / 8; }
  int color_bytes() const { return (palette_bits + 7) / 8; }
  int channels() const {
    const int stored = kind() == Kind::palette ? palette_bits : bits;
    if (kind() == Kind::grey) return stored == 16 ? 2 : 1;
    return stored == 32 ? 4 : 3;  // what the descriptor says of alpha is often wrong
  }
};

std::optional<Header> header_of(std::string_view contents) {
  if (contents.size() < Header::kBytes) return std::nullopt;
  const auto byte = [&](int at) { return static_cast<int>(static_cast<unsigned char>(contents[at])); };
  const auto word = [&](int at) { return byte(at) | byte(at + 1) << 8; };
  return Header{byte(0), byte(1), byte(2), word(3), word(5), byte(7), word(12), word(14), byte(16), byte(17)};
}

bool is_color(int bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; }

/// Whether the fields are ones that the specification has.
bool is_plausible(const Header& header) {
  if (header.has_palette > 1 || (header.type & ~8) < 1 || (header.type & ~8) > 3) return false;
  if (header.has_palette && !is_color(header.palette_bits)) return false;
  switch (header.kind()) {
    case Kind::palette:
      return header.has_palette && (header.bits == 8 || header.bits == 16);
    case Kind::color:
      return is_color(header.bits);
    case Kind::grey:
      return header.bits == 8 || header.bits == 16;
  }
  return false;
}

/// Appends the channels of a stored colour: blue, green, red, alpha, or five bits of each in a word.
void append_color(const std::uint8_t* stored, int bits, Array<std::uint8_t>& bytes) {
  if (bits >= 24) {
    bytes.insert(bytes.end(), {stored[2], stored[1], stored[0]});
    if (bits == 32) bytes.push_back(stored[3]);
    return;
  }
  const unsigned word = stored[0] | stored[1] << 8;
  for (const int shift : {10, 5, 0}) bytes.push_back(scaled_integer<std::uint8_t>(word >> shift & 31, 31));
}

/// Appends a stored pixel. False if it has a colour that the palette has not.
bool append_pixel(const Header& header, std::string_view palette, const std::uint8_t* stored,
                  Array<std::uint8_t>& bytes) {
  if (header.kind() == Kind::grey) {
    bytes.insert(bytes.end(), stored, stored + header.pixel_bytes());
  } else if (header.kind() == Kind::color) {
    append_color(stored, header.bits, bytes);
  } else {
    const int index = (header.bits == 16 ? stored[0] | stored[1] << 8 : stored[0]) - header.palette_first;
    if (index < 0 || index >= header.palette_length) return false;
    const char* color = palette.data() + static_cast<std::ptrdiff_t>(index) * header.color_bytes();
    append_color(reinterpret_cast<const std::uint8_t*>(color), header.palette_bits, bytes);
  }
  return true;
}

/// Appends every pixel in the file's order: runs of up to 128, or as they are.
std::string append_pixels(const Header& header, std::string_view palette, Bytes data, Array<std::uint8_t>& bytes) {
  const std::string cut_off = "its pixels are cut off";
  for (std::int64_t left = std::int64_t{header.width} * header.height; left > 0;) {
    std::int64_t count = left;
    bool repeats = false;
    if (header.is_encoded()) {
      const auto packet = data.take<std::uint8_t>();
      if (!packet) return cut_off;
      repeats = (*packet & 0x80) != 0;
      count = std::min<std::int64_t>((*packet & 0x7f) + 1, left);
    }
    const auto stored = data.take(static_cast<std::size_t>((repeats ? 1 : count) * header.pixel_bytes()));
    if (!stored) return cut_off;
    const auto* pixel = reinterpret_cast<const std::uint8_t*>(stored->data());
    for (std::int64_t i = 0; i < count; ++i) {
      if (!append_pixel(header, palette, pixel, bytes)) return kNotInPalette;
      if (!repeats) pixel += header.pixel_bytes();
    }
    left -= count;
  }
  return {};
}

/// Makes the top left pixel the first one.
void turn(const Header& header, RasterImage& image) {
  constexpr int kFromTheRight = 0x10, kFromTheTop = 0x20;
  const std::ptrdiff_t row = std::ptrdiff_t{image.width} * image.channels;
  auto* const bytes = image.bytes.data();
  if ((header.descriptor & kFromTheTop) == 0) {
    for (int y = 0; y < image.height / 2; ++y) {
      std::swap_ranges(bytes + y * row, bytes + (y + 1) * row, bytes + (image.height - 1 - y) * row);
    }
  }
  if ((header.descriptor & kFromTheRight) == 0) return;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width / 2; ++x) {
      auto* const left = bytes + y * row + std::ptrdiff_t{x} * image.channels;
      std::swap_ranges(left, left + image.channels,
                       bytes + y * row + std::ptrdiff_t{image.width - 1 - x} * image.channels);
    }
  }
}

}  // namespace

bool is_targa(std::string_view contents) {
  const auto header = header_of(contents);
  return header && is_plausible(*header);
}

std::string read_targa(std::string_view contents, RasterImage& image) {
  const auto header = header_of(contents);
  if (!header || !is_plausible(*header)) return "unknown or damaged image file";
  if (header->width < 1 || header->height < 1) return "it has no pixels";
  Bytes data(contents.substr(Header::kBytes));
  const int palette_bytes = header->has_palette * header->palette_length * header->color_bytes();
  if (!data.take(header->id_bytes)) return "its header is cut off";
  const auto palette = data.take(palette_bytes);
  if (!palette) return "its palette is cut off";
  // A packet of 128 pixels has at least two bytes.
  const std::uint64_t pixels = static_cast<std::uint64_t>(header->width) * header->height;
  const std::uint64_t least = header->is_encoded() ? pixels / 128 * 2 : pixels * header->pixel_bytes();
  if (least > data.size()) return does_not_fit(header->width, header->height, contents.size());
  if (pixels * header->channels() > kMostImageValues) {
    return too_many_values(size_text(header->width, header->height) + " pixels", header->channels());
  }
  image.width = header->width;
  image.height = header->height;
  image.channels = header->channels();
  image.bytes.reserve(static_cast<std::size_t>(pixels) * image.channels);
  std::string error = append_pixels(*header, *palette, data, image.bytes);
  if (error.empty()) turn(*header, image);
  return error;
}

}  // namespace norrsken
