// A plane lit from above, seen from above: the scene in which the direct light of each pixel is known.
#pragma once

#include <array>

#include "tests/oracle/scene.h"
#include "tests/statistics/picture.h"

namespace norrsken::closed_form {

/// The plane z = 0, of 20 x 20 units, seen from (0,0,4) straight down, +y at the top and +x to the right, 4 x 4 units
/// in view (53.13 degrees). The lights are out of view, above the plane's horizon, and none hides another.
/// tests/scenes/plane.xml is the same scene.
struct PlaneScene {
  static constexpr oracle::Rgb kAlbedo{0.6, 0.3, 0.9};
  static constexpr oracle::Camera kCamera{{0, 0, 4}, {-2, 2, 0}, {4, 0, 0}, {0, -4, 0}};
  static constexpr oracle::PointLight kPoint{{1, 0.5, 2}, {7, 8, 9}};
  /// Faces down.
  static constexpr std::array<oracle::Vec, 4> kRectangle = {{{-1, -0.5, 5}, {2, -0.5, 5}, {2, 1, 5}, {-1, 1, 5}}};
  static constexpr oracle::Rgb kRectangleRadiance{3, 4, 5};
  static constexpr std::array<oracle::Vec, 3> kTriangle = {{{3, -1, 4.5}, {3, 1, 5}, {4, 0.5, 4.5}}};
  static constexpr oracle::Rgb kTriangleRadiance{6, 2, 1};
  static constexpr oracle::Vec kSphereCentre{-3.5, 0, 5};
  static constexpr double kSphereRadius = 0.8;
  static constexpr oracle::Rgb kSphereRadiance{2, 3, 7};

  enum class Light { point, rectangle, triangle, sphere, all };

  /// The noiseless image: closed forms averaged over each pixel's square.
  static statistics::Picture image(Light light, int width, int height);
};

}  // namespace norrsken::closed_form
