// Images in formats that are read without OpenImageIO, which brings 260 libraries with it. Version 2.4 of it also
// reads BMP and TGA past the ends of its buffers if a file is made for it (CVE-2023-22845 and -24473; its issue 5158), and
// loses memory whenever libpng complains; and of a Radiance picture it does not heed in which order the pixels are.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "base/memory.h"
#include "formats/texel_image.h"
#include "norrsken/image.h"

namespace norrsken {

/// Row 0 is the top. width * height * channels values in one of the arrays: integers of 8 or 16 bits, or floats.
struct RasterImage {
  int width = 0, height = 0;
  int channels = 0;        ///< 1: grey, 2: grey and alpha, 3: red, green, blue, 4: with alpha
  bool is_linear = false;  ///< else colours are stored with sRGB's transfer function; alpha is always as it is
  Array<std::uint8_t> bytes;
  Array<std::uint16_t> words;
  Array<float> floats;  ///< linear
  std::map<std::string, std::string> metadata;
};

/// Whether these are the contents of a BMP, PNG or Radiance file (magic numbers), or of a TGA file: it has none, but no other format that
/// is read has a header that is one of TGA.
bool is_bmp(std::string_view contents);
bool is_png(std::string_view contents);
bool is_radiance(std::string_view contents);
bool is_targa(std::string_view contents);

/// Read the image out of a file's contents: empty, or what is wrong. A header that promises more than the file can hold is.
/// May throw MemoryExceeded.
///
/// BMP: 1, 4 and 8 bits a pixel with a palette (grey if all of its colours are), 4 and 8 also run-length encoded; 16, 24 and
/// 32 bits. Microsoft, "Bitmap Storage", "Bitmap Compression", and the structures BITMAPCOREHEADER to BITMAPV5HEADER.
std::string read_bmp(std::string_view contents, RasterImage& image);
/// PNG: all of it, through libpng; what 16 bits are in 16 bits, all else in 8. Text is metadata.
std::string read_png(std::string_view contents, RasterImage& image);
/// Radiance: flat, and both kinds of runs; RGBE and XYZE; rows and columns in any of the eight orders. What EXPOSURE, GAMMA and
/// other lines say is not heeded, as in Mitsuba. Ward, "Radiance File Formats", section "Picture File Format (.hdr)".
std::string read_radiance(std::string_view contents, RasterImage& image);
/// Bytes of a file from `at` on: `most` of them, or as many as there are.
using ReadAt = std::function<std::string(std::uint64_t at, std::size_t most)>;
/// Its size, channels, and texts before and behind the pixels, which are not read.
std::string read_png_header(const ReadAt& read_at, ImageHeader& header);
/// TGA: grey, colour and palettes, also run-length encoded. Truevision, "TGA File Format Specification", version 2.0, 1991;
/// what it calls extension and developer areas is not looked at.
std::string read_targa(std::string_view contents, RasterImage& image);

/// Whether it is one of them, and what is read of it: float channels, within `most_bytes`, or texels. Empty, or what is
/// wrong; reading texels may throw MemoryExceeded.
bool is_raster_image(std::string_view contents);
std::string read_raster_image(std::string_view contents, std::uint64_t most_bytes, Image& image);
std::string read_raster_texels(std::string_view contents, TexelImage& image);

/// What BMP and TGA are told whose pixel has an index beyond the palette.
inline constexpr const char* kNotInPalette = "a pixel has a colour that its palette lacks";

/// An integer of [0, most] scaled to [0, 255], rounded.
constexpr std::uint8_t byte_from(std::uint64_t value, std::uint64_t most) {
  return static_cast<std::uint8_t>((value * 255 + most / 2) / most);
}

}  // namespace norrsken
