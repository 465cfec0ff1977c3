// What is said of the size that a header gives an image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/memory.h"

namespace norrsken {

/// Values that an image may have in all, so that a forged header cannot ask for all the memory: 4 GiB of float.
inline constexpr std::uint64_t kMostImageValues = std::uint64_t{1} << 30;

inline std::string size_text(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// `pixels`: "60000x60000 pixels", or with what else takes room.
inline std::string too_many_values(const std::string& pixels, int channels) {
  return "it has " + pixels + " of " + std::to_string(channels) + " channels, accepted are " +
         std::to_string(kMostImageValues) + " values in all";
}

/// Whether a file of so many bytes may hold so many pixels: deflate makes at most 1032 bytes of one (zlib's manual), runs
/// make less, and a pixel has a bit or more.
constexpr bool may_hold(std::uint64_t pixels, std::uint64_t file_bytes) {
  return pixels / (std::uint64_t{8} * 1032) <= file_bytes;
}

/// Of a file that cannot hold so many pixels.
inline std::string does_not_fit(std::int64_t width, std::int64_t height, std::uint64_t file_bytes) {
  return "its header says that it has " + size_text(width, height) + " pixels, which do not fit a file of " +
         memory_text(file_bytes);
}

}  // namespace norrsken
