// perspective: a pinhole camera.
//
// Parameters
//   fov                       number, degrees, above 0 and below 180
//   focal_length              string such as "50mm" (the default), in place of `fov`: the focal length that gives this
//                             picture on 35 mm film, measured along the diagonal
//   fov_axis                  x (default), y, diagonal, smaller or larger: the side of the image that `fov` spans
//   near_clip, far_clip       numbers above 0, scene units along the axis (default 0.01 and 10000): nothing nearer or
//                             farther is seen
//   principal_point_offset_x  number, share of the image's width (default 0): what is in the middle of the image without
//                             it moves left by as much
//   principal_point_offset_y  number, share of the image's height (default 0): the same, up
//   to_world                  transform without scale; local +z is the direction of view, +y up and +x left
// Children: film, sampler.
// Measure: every film point has the same weight.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "base/numbers.h"
#include "base/text.h"
#include "compile/plugins.h"

namespace norrsken {
namespace {

/// 36 x 24 mm.
const double kFilmDiagonal = std::hypot(36.0, 24.0);

/// Angle in radians along the film's diagonal.
double focal_length_angle(Parameters& p) {
  const std::string text = p.text("focal_length", "50mm");
  constexpr std::string_view kUnit = "mm";
  double millimetres = 0;
  const bool parsed = text.ends_with(kUnit) && parse_number(trim(std::string_view(text).substr(0, text.size() - 2)),
                                                            millimetres) == NumberStatus::ok;
  if (!parsed || millimetres < 1e-3 || millimetres > 1e6) {
    p.error("focal_length", fmt::format("'focal_length' is {}", quoted(text)),
            "a length from 0.001mm to 1000000mm, such as 50mm");
    millimetres = 50;
  }
  return 2 * std::atan(kFilmDiagonal / (2 * millimetres));
}

/// Half the image's width at distance 1.
double half_width(Parameters& p, double aspect) {
  std::string axis = p.choice("fov_axis", "x", {"x", "y", "diagonal", "smaller", "larger"});
  const double degrees = p.number("fov", 45, 0, 180, Ends::open);
  double angle = focal_length_angle(p);
  if (!p.has("fov")) {
    axis = "diagonal";
  } else {
    angle = glm::radians(degrees);
    if (p.has("focal_length")) {
      p.error("focal_length", "sensor 'perspective' has both 'fov' and 'focal_length'", "one of them");
    }
  }
  const double half = std::tan(angle / 2);
  if (axis == "smaller") axis = aspect > 1 ? "y" : "x";
  if (axis == "larger") axis = aspect > 1 ? "x" : "y";
  if (axis == "y") return half * aspect;
  if (axis == "diagonal") return half / std::sqrt(1 + 1 / (aspect * aspect));
  return half;
}

bool keeps_lengths(const glm::dmat3& linear) {
  const glm::dmat3 gram = glm::transpose(linear) * linear;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(gram[i][j] - (i == j)) > 1e-3) return false;
    }
  }
  return true;
}

void store(float (&out)[3], const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

}  // namespace

CameraRecord compile_sensor_perspective(Parameters& p, Builder& builder, const FilmSettings& film) {
  const double width = film.width, height = film.height;
  const double half_x = half_width(p, width / height);
  const double half_y = half_x * height / width;
  const double near_clip = p.number("near_clip", 1e-2, 0, kMaxCoordinate, Ends::open_below);
  const double far_clip = p.number("far_clip", 1e4, 0, kMaxCoordinate, Ends::open_below);
  if (near_clip >= far_clip) {
    p.error(p.has("near_clip") ? "near_clip" : "far_clip",
            fmt::format("'near_clip' is {}, but 'far_clip' is {}", near_clip, far_clip),
            "a near_clip smaller than the far_clip");
  }
  const double offset_x = p.number("principal_point_offset_x", 0, -1e6, 1e6);
  const double offset_y = p.number("principal_point_offset_y", 0, -1e6, 1e6);
  const glm::dmat4 to_world = p.transform("to_world");
  const glm::dmat3 linear(to_world);
  if (!keeps_lengths(linear)) {
    p.error("to_world", "'to_world' of a sensor scales", "translations, rotations and lookat");
  }
  const glm::dvec3 left = linear[0], up = linear[1], forward = glm::normalize(linear[2]);

  // Film position (px, py) looks along forward + x left + y up, with x from half_x at px = 0 to -half_x at px = width
  // and y from half_y at py = 0 to -half_y at py = height.
  CameraRecord camera{};
  store(camera.origin, to_world[3]);
  store(camera.base, forward + (1 - 2 * offset_x) * half_x * left + (1 - 2 * offset_y) * half_y * up);
  store(camera.du, -2 * half_x / width * left);
  store(camera.dv, -2 * half_y / height * up);
  store(camera.forward, forward);
  camera.near_clip = static_cast<float>(near_clip);
  camera.far_clip = static_cast<float>(far_clip);
  builder.describe(p.node(), fmt::format("{:.4g} degrees wide", glm::degrees(2 * std::atan(half_x))));
  return camera;
}

}  // namespace norrsken
