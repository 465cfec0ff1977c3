// For tests: images in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace norrsken::testing {

/// A Radiance HDR file of these texels, row by row from the top: 8 bits of each component, with a shared exponent.
inline std::string radiance_file(int width, int height, const std::vector<std::array<double, 3>>& texels) {
  std::string bytes =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  for (const auto& texel : texels) {
    int exponent = 0;
    const double largest = std::max({texel[0], texel[1], texel[2]});
    std::frexp(largest, &exponent);
    for (const double component : texel) bytes += static_cast<char>(std::lround(std::ldexp(component, 8 - exponent)));
    bytes += static_cast<char>(largest > 0 ? exponent + 128 : 0);
  }
  return bytes;
}

}  // namespace norrsken::testing
