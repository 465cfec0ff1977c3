// Images as textures want them: as compact as the file has them, colour or grey.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/memory.h"

namespace norrsken {

/// Row 0 is the top. Alpha is left out, and grey is told from colour.
struct TexelImage {
  int width = 0, height = 0;
  int channels = 0;  ///< 1 or 3
  /// Integers of the file: stored with sRGB's transfer function, unless it says that they are linear.
  bool is_encoded = false;
  /// width * height * channels: 8-bit integers, or if the file has others `values`, in which integers are in [0, 1].
  Array<std::uint8_t> bytes;
  Array<float> values;
  /// What a user should know of how the file was taken: "has ..."; or nothing.
  std::string remark;
};

/// Reads an image out of a file's `contents`; `path` is for its extension. Empty, or what is wrong: a header that promises
/// more than the file can hold is. What the image and its decoder take is counted; may throw MemoryExceeded.
std::string read_texels(const std::string& path, const std::string& contents, TexelImage& image);

}  // namespace norrsken
