// TIFF files, through libtiff: what a pixel is, and where it stands in strips or tiles.
#include <Imath/half.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <string>

#include "image/raster_image.h"
#include "image/size.h"

namespace norrsken {
namespace {

/// The file as libtiff reads it, and what it complained of.
struct File {
  std::string_view contents;
  std::uint64_t position = 0;
  std::string error;
};

File& file_of(thandle_t handle) { return *static_cast<File*>(handle); }

tmsize_t on_read(thandle_t handle, void* bytes, tmsize_t size) {
  File& file = file_of(handle);
  const std::string_view left = file.contents.substr(std::min<std::uint64_t>(file.position, file.contents.size()));
  const std::size_t count = left.copy(static_cast<char*>(bytes), static_cast<std::size_t>(std::max<tmsize_t>(size, 0)));
  file.position += count;
  return static_cast<tmsize_t>(count);
}
tmsize_t on_write(thandle_t, void*, tmsize_t) { return 0; }
toff_t on_seek(thandle_t handle, toff_t offset, int whence) {
  File& file = file_of(handle);
  if (whence == SEEK_CUR) offset += file.position;
  if (whence == SEEK_END) offset += file.contents.size();
  return file.position = offset;
}
int on_close(thandle_t) { return 0; }
toff_t on_size(thandle_t handle) { return file_of(handle).contents.size(); }

/// Keeps the first complaint, which the others follow from.
int on_error(TIFF*, void* data, const char*, const char* format, std::va_list arguments) {
  std::string& error = file_of(data).error;
  if (!error.empty()) return 1;
  std::array<char, 300> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  error = text.data();
  return 1;
}
int on_warning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff open(File& file) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  if (!options) return {nullptr, TIFFClose};
  // Lists of strips take twice what they do in the file.
  constexpr tmsize_t kAtOnce = tmsize_t{16} << 20;
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kAtOnce + static_cast<tmsize_t>(2 * file.contents.size()));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &file);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &file);
  // "m": not mapped into memory, where it is already.
  return {TIFFClientOpenExt("image", "rm", &file, on_read, on_write, on_seek, on_close, on_size, nullptr, nullptr,
                            options.get()),
          TIFFClose};
}

template <class T>
T field(TIFF* tiff, ttag_t tag, T otherwise) {
  T value{};
  return TIFFGetFieldDefaulted(tiff, tag, &value) != 0 ? value : otherwise;
}

struct Named {
  int number;
  const char* name;
};
template <std::size_t N>
std::string name_of(int number, const Named (&names)[N]) {
  const auto* found = std::ranges::find(names, number, &Named::number);
  return found != std::end(names) ? found->name : "number " + std::to_string(number);
}

/// libtiff knows more, each of them one more decoder for a damaged file to break.
constexpr int kCompressions[] = {COMPRESSION_NONE,          COMPRESSION_CCITTRLE, COMPRESSION_CCITTFAX3,
                                 COMPRESSION_CCITTFAX4,     COMPRESSION_LZW,      COMPRESSION_JPEG,
                                 COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE,  COMPRESSION_PACKBITS};
constexpr Named kOtherCompressions[] = {{COMPRESSION_OJPEG, "JPEG as in TIFF 6.0"},
                                        {COMPRESSION_LZMA, "LZMA"},
                                        {COMPRESSION_ZSTD, "Zstandard"},
                                        {COMPRESSION_WEBP, "WebP"},
                                        {COMPRESSION_SGILOG, "LogLuv"},
                                        {COMPRESSION_SGILOG24, "LogLuv"},
                                        {COMPRESSION_LERC, "LERC"},
                                        {COMPRESSION_JP2000, "JPEG 2000"}};
constexpr Named kOtherColors[] = {{PHOTOMETRIC_MASK, "a mask"},       {PHOTOMETRIC_YCBCR, "YCbCr without JPEG"},
                                  {PHOTOMETRIC_CIELAB, "CIE L*a*b*"}, {PHOTOMETRIC_ICCLAB, "ICC L*a*b*"},
                                  {PHOTOMETRIC_ITULAB, "ITU L*a*b*"}, {PHOTOMETRIC_CFA, "a colour filter's"},
                                  {PHOTOMETRIC_LOGL, "LogL"},         {PHOTOMETRIC_LOGLUV, "LogLuv"}};
constexpr Named kOtherNumbers[] = {{SAMPLEFORMAT_INT, "signed integers"},
                                   {SAMPLEFORMAT_COMPLEXINT, "complex integers"},
                                   {SAMPLEFORMAT_COMPLEXIEEEFP, "complex numbers"},
                                   {SAMPLEFORMAT_UINT, "integers"},
                                   {SAMPLEFORMAT_VOID, "integers"},
                                   {SAMPLEFORMAT_IEEEFP, "floats"}};

/// What the first directory says.
struct Header {
  std::uint32_t width = 0, height = 0;
  std::uint32_t block_width = 0, block_height = 0;  ///< of a tile or strip
  bool is_tiled = false, is_planar = false, is_float = false;
  int samples = 0, bits = 0, colors = 0, compression = 0;

  bool has(int kind) const { return colors == kind; }
  /// Samples of a pixel that stand side by side.
  int block_samples() const { return is_planar ? 1 : samples; }
  std::uint64_t block_row_bytes() const {
    return (std::uint64_t{block_width} * static_cast<std::uint64_t>(block_samples()) *
                static_cast<std::uint64_t>(bits) +
            7) /
           8;
  }
  std::uint64_t block_bytes() const { return block_row_bytes() * block_height; }
  /// Samples that make colour or grey, or stand for it.
  int color_samples() const {
    if (has(PHOTOMETRIC_SEPARATED)) return 4;
    if (has(PHOTOMETRIC_RGB)) return 3;
    return has(PHOTOMETRIC_PALETTE) || samples < 3 ? 1 : 3;
  }
  /// Samples that are read: with the first one behind the colour, which is alpha.
  int read_samples() const { return std::min(samples, color_samples() + (has(PHOTOMETRIC_PALETTE) ? 0 : 1)); }
};

Header read_header(TIFF* tiff) {
  Header header;
  header.width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  header.height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  header.samples = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  header.bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  header.is_planar = field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, 1) == PLANARCONFIG_SEPARATE;
  header.is_tiled = TIFFIsTiled(tiff) != 0;
  header.compression = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  header.colors =
      field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, header.samples >= 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  header.is_float = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) == SAMPLEFORMAT_IEEEFP;
  if (header.has(PHOTOMETRIC_YCBCR) && header.compression == COMPRESSION_JPEG &&
      TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB) != 0) {
    header.colors = PHOTOMETRIC_RGB;  // libjpeg turns it into that
  }
  if (header.is_tiled) {
    header.block_width = field<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
    header.block_height = field<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
  } else {
    header.block_width = header.width;
    header.block_height = std::min(field<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, header.height), header.height);
  }
  return header;
}

/// What stands in the way of reading it, or nothing.
std::string objection_to(TIFF* tiff, const Header& header, std::size_t file_bytes) {
  const std::string pixels = size_text(header.width, header.height) + " pixels";
  if (header.width < 1 || header.height < 1 || header.samples < 1 || header.block_width < 1 || header.block_height < 1)
    return "it has no pixels";
  if (field<std::uint32_t>(tiff, TIFFTAG_IMAGEDEPTH, 1) > 1) return "volume images are not read";
  if (std::ranges::find(kCompressions, header.compression) == std::end(kCompressions)) {
    return "it is compressed with " + name_of(header.compression, kOtherCompressions) +
           ", accepted are Deflate, LZW, PackBits, JPEG, CCITT and none";
  }
  if (header.has(PHOTOMETRIC_SEPARATED) &&
      (header.samples < 4 || field<std::uint16_t>(tiff, TIFFTAG_INKSET, INKSET_CMYK) != INKSET_CMYK)) {
    return "it holds inks other than cyan, magenta, yellow and black";
  }
  constexpr int kColors[] = {PHOTOMETRIC_MINISWHITE, PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_RGB, PHOTOMETRIC_PALETTE,
                             PHOTOMETRIC_SEPARATED};
  if (std::ranges::find(kColors, header.colors) == std::end(kColors) ||
      (header.has(PHOTOMETRIC_RGB) && header.samples < 3)) {
    return "its colours are " +
           (header.has(PHOTOMETRIC_RGB) ? "RGB in fewer than 3 channels" : name_of(header.colors, kOtherColors)) +
           ", accepted are grey, RGB, palettes, CMYK, and YCbCr in JPEG";
  }
  const int numbers = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const bool is_integer = numbers == SAMPLEFORMAT_UINT || numbers == SAMPLEFORMAT_VOID;
  const bool is_accepted = header.is_float
                               ? header.bits == 16 || header.bits == 32 || header.bits == 64
                               : is_integer && ((header.bits >= 1 && header.bits <= 16) || header.bits == 32);
  if (!is_accepted) {
    return "its pixels are " + name_of(numbers, kOtherNumbers) + " of " + std::to_string(header.bits) +
           " bits, accepted are unsigned integers of 1 to 16 and 32 bits and floats of 16, 32 and 64";
  }
  const bool is_exact_color = !header.has(PHOTOMETRIC_PALETTE) && !header.has(PHOTOMETRIC_SEPARATED);
  if (!is_exact_color && (header.is_float || header.bits > (header.has(PHOTOMETRIC_PALETTE) ? 8 : 16))) {
    return "its palette or inks are of " + std::to_string(header.bits) +
           " bits, accepted are integers of up to 8 and 16";
  }
  // Deflate and PackBits; others make more of a byte.
  const bool is_bounded = header.compression == COMPRESSION_NONE || header.compression == COMPRESSION_DEFLATE ||
                          header.compression == COMPRESSION_ADOBE_DEFLATE || header.compression == COMPRESSION_PACKBITS;
  const std::uint64_t count = std::uint64_t{header.width} * header.height;
  if (is_bounded && !may_hold(count, file_bytes)) return does_not_fit(header.width, header.height, file_bytes);
  if (std::max<std::uint64_t>(count, std::uint64_t{header.block_width} * header.block_height) >
      kMostImageValues / static_cast<std::uint64_t>(header.samples)) {
    return too_many_values(pixels, header.samples);
  }
  const std::uint64_t block_bytes = header.is_tiled ? TIFFTileSize64(tiff) : TIFFStripSize64(tiff);
  if (block_bytes != header.block_bytes()) return "its pixels are not as many bytes as its header says";
  return {};
}

/// A sample that a row holds, by its number, as an integer.
std::uint32_t integer_at(const std::uint8_t* row, std::uint64_t number, int bits) {
  const auto load = [&](auto value) {
    std::memcpy(&value, row + number * sizeof value, sizeof value);
    return std::uint32_t{value};
  };
  if (bits == 8) return row[number];
  if (bits == 16) return load(std::uint16_t{});
  if (bits == 32) return load(std::uint32_t{});
  std::uint32_t value = 0;
  for (std::uint64_t bit = number * static_cast<std::uint64_t>(bits), end = bit + static_cast<std::uint64_t>(bits);
       bit < end; ++bit) {
    value = value << 1 | (row[bit / 8] >> (7 - bit % 8) & 1);
  }
  return value;
}

float float_at(const std::uint8_t* row, std::uint64_t number, int bits) {
  const auto load = [&](auto value) {
    std::memcpy(&value, row + number * sizeof value, sizeof value);
    return value;
  };
  if (bits == 32) return load(float{});
  if (bits == 64) return static_cast<float>(load(double{}));
  Imath::half half;
  half.setBits(load(std::uint16_t{}));
  return half;
}

/// Decodes the image block by block and calls `use(place, sample, row, number)` for each of the samples that are read:
/// the pixel's place in the image, the number of the sample in it, and where it is. `grow(rows)` comes first. Empty, or what is wrong.
template <class Grow, class Use>
std::string for_each_sample(TIFF* tiff, File& file, const Header& header, const Grow& grow, const Use& use) {
  Array<std::uint8_t> block(header.block_bytes());
  const MemoryReservation stored(header.block_bytes());  // as it is in the file
  const std::uint64_t row_bytes = header.block_row_bytes();
  const int block_samples = header.block_samples();
  for (std::uint32_t top = 0; top < header.height; top += std::min(header.block_height, header.height - top)) {
    const std::uint32_t rows = std::min(header.block_height, header.height - top);
    grow(top + rows);
    for (std::uint32_t left = 0; left < header.width; left += std::min(header.block_width, header.width - left)) {
      const std::uint32_t columns = std::min(header.block_width, header.width - left);
      for (int plane = 0; plane < (header.is_planar ? header.read_samples() : 1); ++plane) {
        const auto number = static_cast<std::uint16_t>(plane);
        const std::uint64_t wanted = header.is_tiled ? header.block_bytes() : row_bytes * rows;
        const auto size = static_cast<tmsize_t>(wanted);
        const tmsize_t count =
            header.is_tiled ? TIFFReadEncodedTile(tiff, TIFFComputeTile(tiff, left, top, 0, number), block.data(), size)
                            : TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, top, number), block.data(), size);
        if (count != size || !file.error.empty()) {
          return "its pixels are damaged or cut off" + (file.error.empty() ? "" : " (" + file.error + ")");
        }
        const int first = header.is_planar ? plane : 0;
        const int samples = header.is_planar ? 1 : header.read_samples();
        for (std::uint32_t y = 0; y < rows; ++y) {
          const std::uint8_t* const row = &block[y * row_bytes];
          for (std::uint32_t x = 0; x < columns; ++x) {
            const std::size_t place = std::size_t{top + y} * header.width + left + x;
            for (int sample = 0; sample < samples; ++sample) {
              use(place, first + sample, row,
                  std::uint64_t{x} * static_cast<std::uint64_t>(block_samples) + static_cast<std::uint64_t>(sample));
            }
          }
        }
      }
    }
  }
  return {};
}

/// Integers of up to 16 bits, and of them colours that are named by a palette or made by inks.
template <class T>
std::string read_integers(TIFF* tiff, File& file, const Header& header, RasterImage& image, Array<T>& values) {
  constexpr std::uint64_t kWhite = std::numeric_limits<T>::max();
  const std::uint32_t most = (1u << header.bits) - 1;
  std::array<std::uint16_t*, 3> palette{};
  const bool has_palette = header.has(PHOTOMETRIC_PALETTE);
  if (has_palette && TIFFGetField(tiff, TIFFTAG_COLORMAP, &palette[0], &palette[1], &palette[2]) == 0) {
    return "it has no palette";
  }
  // 16 bits, of which programs that have 8 fill the lower ones as they like; some old ones store 8 where 16 belong.
  const bool is_small = has_palette && std::ranges::all_of(palette, [&](const std::uint16_t* colors) {
                          return std::all_of(colors, colors + most + 1, [](std::uint16_t c) { return c < 256; });
                        });
  const bool has_inks = header.has(PHOTOMETRIC_SEPARATED);
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t row_values = channels * header.width;
  values.reserve(row_values * header.height);
  return for_each_sample(
      tiff, file, header, [&](std::uint32_t rows) { values.resize(row_values * rows); },
      [&](std::size_t place, int sample, const std::uint8_t* row, std::uint64_t number) {
        std::uint32_t value = integer_at(row, number, header.bits);
        T* const pixel = &values[place * channels];
        if (has_palette) {
          for (std::size_t c = 0; c < 3; ++c) {
            pixel[c] = static_cast<T>(palette[c][value] >> (is_small ? 0 : 8));
          }
        } else if (has_inks) {
          if (sample < 3) pixel[sample] = scaled_integer<T>(most - value, most);
          if (sample == 4) pixel[3] = scaled_integer<T>(value, most);
          // Black comes behind the others and darkens what they leave of the light.
          for (int c = 0; sample == 3 && c < 3; ++c) {
            pixel[c] = scaled_integer<T>(std::uint64_t{pixel[c]} * (most - value), kWhite * most);
          }
        } else {
          if (sample == 0 && header.has(PHOTOMETRIC_MINISWHITE)) value = most - value;
          pixel[sample] = scaled_integer<T>(value, most);
        }
      });
}

/// Floats, and integers of 32 bits, which are identifiers or counts and no fractions.
std::string read_floats(TIFF* tiff, File& file, const Header& header, RasterImage& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  image.floats.reserve(channels * header.width * header.height);
  return for_each_sample(
      tiff, file, header, [&](std::uint32_t rows) { image.floats.resize(channels * header.width * rows); },
      [&](std::size_t place, int sample, const std::uint8_t* row, std::uint64_t number) {
        image.floats[place * channels + static_cast<std::size_t>(sample)] =
            header.is_float ? float_at(row, number, header.bits)
                            : static_cast<float>(integer_at(row, number, header.bits));
      });
}

}  // namespace

bool is_tiff(std::string_view contents) {
  using namespace std::string_view_literals;
  constexpr std::string_view kMagics[] = {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};
  return std::ranges::any_of(kMagics, [&](std::string_view magic) { return contents.starts_with(magic); });
}

std::string read_tiff(std::string_view contents, RasterImage& image) {
  File file{contents, 0, {}};
  const Tiff tiff = open(file);
  if (!tiff) return "its header is damaged or cut off" + (file.error.empty() ? "" : " (" + file.error + ")");
  const Header header = read_header(tiff.get());
  if (std::string objection = objection_to(tiff.get(), header, contents.size()); !objection.empty()) return objection;
  file.error.clear();
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  const bool has_alpha = header.read_samples() > header.color_samples();
  image.channels = (header.has(PHOTOMETRIC_PALETTE) || header.color_samples() > 1 ? 3 : 1) + (has_alpha ? 1 : 0);
  image.is_linear = header.is_float || header.bits > 16;
  if (!header.has(PHOTOMETRIC_RGB) && header.color_samples() == 3) {
    image.remark = "has several channels of grey: the first three are taken for red, green, blue";
  }
  const int orientation = field<std::uint16_t>(tiff.get(), TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  if (std::string remark = orientation_remark(orientation); !remark.empty()) image.remark = std::move(remark);
  if (image.is_linear) return read_floats(tiff.get(), file, header, image);
  return header.bits <= 8 ? read_integers(tiff.get(), file, header, image, image.bytes)
                          : read_integers(tiff.get(), file, header, image, image.words);
}

}  // namespace norrsken
