// An image as the tests compare it: double precision R, G, B.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace norrsken::statistics {

struct Picture {
  using Pixel = std::array<double, 3>;

  int width = 0, height = 0;
  std::vector<Pixel> pixels;  ///< row 0 at the top

  Picture() = default;
  Picture(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  Pixel& at(int x, int y) { return pixels[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace norrsken::statistics
