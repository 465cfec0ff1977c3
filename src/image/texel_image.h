// Images as textures want them: as compact as the file has them, colour or grey.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/memory.h"
#include "norrsken/image.h"

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

/// Reads an image out of a file's `contents`, which tell its format. Empty, or what is wrong: a header that promises more
/// than the file can hold is. What the image and its decoder take is counted; may throw MemoryExceeded.
std::string read_texels(std::string_view contents, TexelImage& image);

/// What `read_image` does with the contents of a file. Empty, or what is wrong; `image` changes on success only.
std::string read_image_contents(std::string_view contents, std::uint64_t most_bytes, Image& image);

}  // namespace norrsken
