// A plane lit from above, seen from above: the scene in which the direct light of each pixel is known.
#pragma once

#include <array>

#include "tests/oracle/scene.h"
#include "tests/statistics/picture.h"

namespace norrsken::closed_form {

/// The plane z = 0, of 20 x 20 units, seen from (0,0,4) straight down, +y at the top and +x to the right, 4 x 4 units
/// in view (53.13 degrees). Lights: a point, or a rectangle that hangs above the eye and faces down.
struct PlaneScene {
  static constexpr oracle::Rgb kAlbedo{0.6, 0.3, 0.9};
  static constexpr oracle::Camera kCamera{{0, 0, 4}, {-2, 2, 0}, {4, 0, 0}, {0, -4, 0}};
  static constexpr oracle::PointLight kPointLight{{1, 0.5, 2}, {7, 8, 9}};
  static constexpr std::array<oracle::Vec, 4> kRectangle = {{{-1, -0.5, 5}, {2, -0.5, 5}, {2, 1, 5}, {-1, 1, 5}}};
  static constexpr oracle::Rgb kRectangleRadiance{3, 4, 5};

  /// The noiseless images: closed forms averaged over each pixel's square.
  static statistics::Picture lit_by_point(int width, int height);
  static statistics::Picture lit_by_rectangle(int width, int height);
};

}  // namespace norrsken::closed_form
