// Radiance pictures: text lines, a line with the size, and pixels of three mantissas with a common exponent.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/text.h"
#include "color/srgb.h"
#include "image/bytes.h"
#include "image/raster_image.h"
#include "image/size.h"

namespace norrsken {
namespace {

constexpr std::string_view kRgbe = "32-bit_rle_rgbe", kXyze = "32-bit_rle_xyze";
constexpr std::size_t kPixelBytes = 4;

/// The order of the pixels: lines one after the other along the first axis, the pixels of a line along the second.
struct Order {
  std::int64_t lines = 0, line_pixels = 0;
  bool lines_are_rows = true;  ///< else columns
  bool from_bottom = false, from_right = false;

  std::int64_t width() const { return lines_are_rows ? line_pixels : lines; }
  std::int64_t height() const { return lines_are_rows ? lines : line_pixels; }
  /// Where a pixel is in an image whose first row is the top.
  std::size_t place(std::int64_t line, std::int64_t pixel) const {
    const std::int64_t x = lines_are_rows ? pixel : line, y = lines_are_rows ? line : pixel;
    return static_cast<std::size_t>((from_bottom ? height() - 1 - y : y) * width() +
                                    (from_right ? width() - 1 - x : x));
  }
};

/// The next line without its end, LF or CRLF.
std::optional<std::string_view> take_line(std::string_view& left) {
  const std::size_t end = left.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  std::string_view line = left.substr(0, end);
  left.remove_prefix(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// "-Y 512 +X 1024" and its seven relatives.
std::optional<Order> order_from(std::string_view line) {
  struct Axis {
    char sign, name;
    std::int64_t size;
  };
  const auto take_axis = [&line]() -> std::optional<Axis> {
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    if (line.size() < 3) return std::nullopt;
    Axis axis{line[0], line[1], 0};
    line.remove_prefix(2);
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), axis.size);
    const bool is_good = error == std::errc() && axis.size > 0 && axis.size <= INT32_MAX &&
                         (axis.sign == '+' || axis.sign == '-') && (axis.name == 'X' || axis.name == 'Y');
    if (!is_good) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return axis;
  };
  const auto first = take_axis(), second = first ? take_axis() : std::nullopt;
  if (!second || first->name == second->name || line.find_first_not_of(' ') != std::string_view::npos)
    return std::nullopt;
  const Axis &y = first->name == 'Y' ? *first : *second, &x = first->name == 'X' ? *first : *second;
  return Order{first->size, second->size, first->name == 'Y', y.sign == '+', x.sign == '-'};
}

/// A line in which the bytes of a component follow each other, in runs: behind a count above 128 one byte that many times
/// less 128, behind a smaller one as many bytes. `line` has room for the pixels.
bool read_components(Bytes& bytes, std::uint8_t* line, std::size_t pixels) {
  for (std::size_t component = 0; component < kPixelBytes; ++component) {
    for (std::size_t at = 0; at < pixels;) {
      const auto code = bytes.take<std::uint8_t>();
      if (!code) return false;
      const bool is_run = *code > 128;
      const std::size_t count = is_run ? *code - 128 : *code;
      const auto values = bytes.take(is_run ? 1 : count);
      if (count == 0 || count > pixels - at || !values) return false;
      for (std::size_t i = 0; i < count; ++i)
        line[(at + i) * kPixelBytes + component] = static_cast<std::uint8_t>((*values)[is_run ? 0 : i]);
      at += count;
    }
  }
  return true;
}

/// A line of pixels. Mantissas of 1 repeat the pixel before, as often as the exponent says; several of those behind each
/// other are the bytes of one number, the lowest first.
bool read_pixels(Bytes& bytes, Array<std::uint8_t>& rgbe, std::size_t pixels) {
  const std::size_t begin = rgbe.size(), end = begin + pixels * kPixelBytes;
  for (int shift = 0; rgbe.size() < end;) {
    const auto stored = bytes.take(kPixelBytes);
    if (!stored) return false;
    const auto* pixel = reinterpret_cast<const std::uint8_t*>(stored->data());
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      rgbe.insert(rgbe.end(), pixel, pixel + kPixelBytes);
      shift = 0;
      continue;
    }
    const std::uint64_t count = std::uint64_t{pixel[3]} << shift;
    if (rgbe.size() == begin || count > (end - rgbe.size()) / kPixelBytes) return false;
    std::array<std::uint8_t, kPixelBytes> before;
    std::copy_n(rgbe.end() - kPixelBytes, kPixelBytes, before.begin());
    for (std::uint64_t i = 0; i < count; ++i) rgbe.insert(rgbe.end(), before.begin(), before.end());
    shift = std::min(shift + 8, 24);
  }
  return true;
}

bool read_line(Bytes& bytes, Array<std::uint8_t>& rgbe, std::size_t pixels) {
  constexpr std::size_t kLeast = 8, kMost = 0x7fff;  // pixels of lines that may be split into components
  Bytes ahead = bytes;
  const auto marks = ahead.take(kPixelBytes);
  const auto mark = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>((*marks)[i])); };
  if (pixels < kLeast || pixels > kMost || !marks || mark(0) != 2 || mark(1) != 2 || mark(2) >= 128)
    return read_pixels(bytes, rgbe, pixels);
  if ((mark(2) << 8 | mark(3)) != pixels) return false;
  bytes = ahead;
  const std::size_t begin = rgbe.size();
  rgbe.resize(begin + pixels * kPixelBytes);
  return read_components(bytes, rgbe.data() + begin, pixels);
}

}  // namespace

bool is_radiance(std::string_view contents) { return contents.starts_with("#?"); }

std::string read_radiance(std::string_view contents, RasterImage& image) {
  std::string_view left = contents, format = kRgbe;
  for (;;) {
    const auto line = take_line(left);
    if (!line) return "its header has no end";
    if (line->empty()) break;
    if (line->starts_with("FORMAT=")) format = trim(line->substr(7));
  }
  if (format != kRgbe && format != kXyze) {
    return "its FORMAT is neither " + std::string(kRgbe) + " nor " + std::string(kXyze);
  }
  const auto size_line = take_line(left);
  const std::optional<Order> order = size_line ? order_from(*size_line) : std::nullopt;
  if (!order) return "its size is not given as in '-Y 512 +X 1024'";
  const auto pixels = static_cast<std::uint64_t>(order->lines) * static_cast<std::uint64_t>(order->line_pixels);
  if (!may_hold(pixels, contents.size())) return does_not_fit(order->width(), order->height(), contents.size());
  if (pixels > kMostImageValues / 3) return too_many_values(size_text(order->width(), order->height()) + " pixels", 3);

  Bytes bytes(left);
  Array<std::uint8_t> rgbe;
  rgbe.reserve(pixels * kPixelBytes);
  for (std::int64_t line = 0; line < order->lines; ++line) {
    if (!read_line(bytes, rgbe, static_cast<std::size_t>(order->line_pixels)))
      return "line " + std::to_string(line + 1) + " of its pixels is damaged or cut off";
  }

  image.width = static_cast<int>(order->width());
  image.height = static_cast<int>(order->height());
  image.channels = 3;
  image.is_linear = true;
  image.floats.resize(pixels * 3);
  const std::uint8_t* stored = rgbe.data();
  for (std::int64_t line = 0; line < order->lines; ++line) {
    for (std::int64_t pixel = 0; pixel < order->line_pixels; ++pixel, stored += kPixelBytes) {
      constexpr int kBias = 128 + 8;
      const double scale = stored[3] == 0 ? 0 : std::ldexp(1.0, stored[3] - kBias);
      ColorVector color{stored[0] * scale, stored[1] * scale, stored[2] * scale};
      if (format == kXyze) color = kSrgbFromXyz * color;
      for (std::size_t c = 0; c < 3; ++c)
        image.floats[3 * order->place(line, pixel) + c] = static_cast<float>(color[c]);
    }
  }
  return {};
}

}  // namespace norrsken
