// Encoders of the image formats that are written.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "norrsken/image.h"

namespace norrsken {

/// Interleaved 8-bit RGB, rows from the top.
struct ByteImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Each writes the whole file to `file` and returns what the format's library complains about, or nothing. Failures
/// of the file itself show in `AtomicFile::commit`.

/// Every channel as 32-bit float unless the image says otherwise, ZIP-compressed, with sRGB chromaticities. OpenEXR stores channels sorted by name;
/// programs show R, G, B first.
std::string encode_exr(AtomicFile& file, const Image& image);
/// Tagged as sRGB; metadata become iTXt chunks.
std::string encode_png(AtomicFile& file, const ByteImage& image, const std::map<std::string, std::string>& metadata);
/// Quality 95, chroma not subsampled.
std::string encode_jpeg(AtomicFile& file, const ByteImage& image);

inline constexpr int kLargestPngSide = 1'000'000;  ///< what libpng accepts when it reads
inline constexpr int kLargestJpegSide = 65'500;    ///< JPEG_MAX_DIMENSION
inline constexpr int kLargestExrSide = 1 << 30;    ///< half of the numbers that its windows have

}  // namespace norrsken
