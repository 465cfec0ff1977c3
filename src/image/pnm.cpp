// Netpbm's pictures (bitmaps P1 and P4, greys P2 and P5, colours P3 and P6) and their relatives of floats, PFM.
// "Netpbm user manual", pages pbm, pgm, ppm and pfm.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "image/bytes.h"
#include "image/raster_image.h"
#include "image/size.h"

namespace norrsken {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Words between blanks, of which a `#` begins a comment up to the line's end.
class Words {
 public:
  explicit Words(std::string_view text) : left_(text) {}

  std::string_view left() const { return left_; }
  std::string_view take() {
    skip_blanks();
    const auto* const end = std::ranges::find_if(left_, [](char c) { return is_blank(c) || c == '#'; });
    const std::string_view word(left_.begin(), end);
    left_.remove_prefix(word.size());
    return word;
  }
  template <class T>
  std::optional<T> take_number() {
    const std::string_view word = take();
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
  }
  /// A digit of a bitmap, which needs no blank behind it.
  std::optional<std::uint32_t> take_bit() {
    skip_blanks();
    if (left_.empty() || (left_.front() != '0' && left_.front() != '1')) return std::nullopt;
    const std::uint32_t bit = left_.front() - '0';
    left_.remove_prefix(1);
    return bit;
  }
  /// The one blank that stands before binary pixels.
  bool take_blank() {
    if (left_.empty() || !is_blank(left_.front())) return false;
    left_.remove_prefix(1);
    return true;
  }

 private:
  void skip_blanks() {
    for (; !left_.empty(); left_.remove_prefix(1)) {
      if (left_.front() == '#') {
        left_.remove_prefix(std::min(left_.find_first_of("\n\r"), left_.size()));
        if (left_.empty()) return;
      } else if (!is_blank(left_.front())) {
        return;
      }
    }
  }

  std::string_view left_;
};

struct Header {
  char kind = 0;  ///< '1' to '6', 'f' or 'F'
  std::int64_t width = 0, height = 0;
  std::uint32_t most = 1;  ///< what white is stored as
  float scale = 1;         ///< of floats, which are little-endian if it is negative

  bool is_float() const { return kind == 'f' || kind == 'F'; }
  bool is_bitmap() const { return kind == '1' || kind == '4'; }
  bool is_text() const { return kind >= '1' && kind <= '3'; }
  int channels() const { return kind == '3' || kind == '6' || kind == 'F' ? 3 : 1; }
  std::uint64_t row_values() const { return static_cast<std::uint64_t>(width) * channels(); }
  /// Bytes that a row takes at least.
  std::uint64_t row_bytes() const {
    if (is_float()) return row_values() * sizeof(float);
    if (kind == '4') return (row_values() + 7) / 8;
    return row_values() * (most > 255 && !is_text() ? 2 : 1);
  }
};

std::string read_header(Words& words, Header& header) {
  header.kind = words.take().back();
  const auto width = words.take_number<std::int32_t>(), height = words.take_number<std::int32_t>();
  if (!width || !height) return "its header is damaged or cut off";
  if (*width < 1 || *height < 1) return "it has no pixels";
  header.width = *width;
  header.height = *height;
  if (header.is_float()) {
    const auto scale = words.take_number<float>();
    if (!scale || !std::isfinite(*scale) || *scale == 0) return "its header has no scale";
    header.scale = *scale;
  } else if (!header.is_bitmap()) {
    const auto most = words.take_number<std::uint32_t>();
    if (!most || *most < 1 || *most > 65535) return "its header does not say what white is, accepted are 1 to 65535";
    header.most = *most;
  }
  return header.is_text() || words.take_blank() ? "" : "its header is cut off";
}

/// Floats, the bottom row first.
void read_floats(const Header& header, std::string_view stored, Array<float>& floats) {
  const bool is_swapped = (header.scale < 0) != (std::endian::native == std::endian::little);
  const float scale = std::abs(header.scale);
  floats.reserve(header.row_values() * header.height);
  for (std::int64_t y = header.height; y-- > 0;) {
    Bytes row(stored.substr(y * header.row_bytes(), header.row_bytes()));
    while (const auto bits = row.take<std::uint32_t>()) {
      floats.push_back(std::bit_cast<float>(is_swapped ? __builtin_bswap32(*bits) : *bits) * scale);
    }
  }
}

/// Hands every value to `use`, which returns whether it is good. False where one is not, or is cut off.
template <class Use>
bool for_each_value(const Header& header, Words& words, const Use& use) {
  const std::uint64_t row_values = header.row_values();
  const std::string_view stored = words.left();
  const auto* row = reinterpret_cast<const std::uint8_t*>(stored.data());
  for (std::int64_t y = 0; y < header.height; ++y, row += header.row_bytes()) {
    for (std::uint64_t i = 0; i < row_values; ++i) {
      std::optional<std::uint32_t> value;
      switch (header.kind) {
        case '1':
          value = words.take_bit();
          break;
        case '2':
        case '3':
          value = words.take_number<std::uint32_t>();
          break;
        case '4':
          value = row[i / 8] >> (7 - i % 8) & 1;
          break;
        default:
          value = header.most > 255 ? row[2 * i] << 8 | row[2 * i + 1] : row[i];
      }
      if (!value || *value > header.most) return false;
      use(header.is_bitmap() ? 1 - *value : *value);  // a bit is ink
    }
  }
  return true;
}

}  // namespace

bool is_pnm(std::string_view contents) {
  constexpr std::string_view kKinds = "123456fF";
  return contents.size() > 2 && contents[0] == 'P' && kKinds.find(contents[1]) != std::string_view::npos &&
         (is_blank(contents[2]) || contents[2] == '#');
}

std::string read_pnm(std::string_view contents, RasterImage& image) {
  Header header;
  Words words(contents);
  if (std::string error = read_header(words, header); !error.empty()) return error;
  if (header.row_values() > kMostImageValues / static_cast<std::uint64_t>(header.height)) {
    return too_many_values(size_text(header.width, header.height) + " pixels", header.channels());
  }
  if (header.row_bytes() * static_cast<std::uint64_t>(header.height) > words.left().size()) {
    return does_not_fit(header.width, header.height, contents.size());
  }
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.channels = header.channels();
  image.is_linear = header.is_float();
  if (header.is_float()) {
    read_floats(header, words.left(), image.floats);
    return {};
  }
  const auto values = static_cast<std::size_t>(header.row_values() * header.height);
  bool is_good = false;
  if (header.most > 255) {
    image.words.reserve(values);
    is_good = for_each_value(header, words, [&](std::uint32_t value) {
      image.words.push_back(scaled_integer<std::uint16_t>(value, header.most));
    });
  } else {
    image.bytes.reserve(values);
    is_good = for_each_value(header, words, [&](std::uint32_t value) {
      image.bytes.push_back(scaled_integer<std::uint8_t>(value, header.most));
    });
  }
  return is_good ? "" : "its pixels are cut off, or not numbers of 0 to " + std::to_string(header.most);
}

}  // namespace norrsken
