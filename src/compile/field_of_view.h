// What a camera and a projector share: how wide they see, and how they may be placed.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <string_view>

#include "base/numbers.h"
#include "base/text.h"
#include "scene/parameters.h"

namespace norrsken {

/// 36 x 24 mm.
inline const double kFilmDiagonal = std::hypot(36.0, 24.0);

enum class Span { x, y, diagonal, smaller, larger };
inline constexpr ChoiceParameter<Span> kFovAxis{.name = "fov_axis",
                                                .words = {{{"x", Span::x},
                                                           {"y", Span::y},
                                                           {"diagonal", Span::diagonal},
                                                           {"smaller", Span::smaller},
                                                           {"larger", Span::larger}}},
                                                .text = "the side of the picture that `fov` spans"};
inline constexpr NumberParameter kFov{
    .name = "fov", .fallback = 45, .range = {0, 180, Ends::open}, .unit = "degrees", .in_place_of = "focal_length"};
inline constexpr TextParameter kFocalLength{
    .name = "focal_length",
    .fallback = "50mm",
    .text = "the focal length that gives this picture on 35 mm film, measured along the diagonal"};

/// Angle in radians along the film's diagonal.
inline double focal_length_angle(Parameters& p) {
  const std::string text = p.read(kFocalLength);
  constexpr std::string_view kUnit = "mm";
  std::string_view length = text;
  if (length.ends_with(kUnit)) length.remove_suffix(kUnit.size());
  double millimetres = 0;
  const bool parsed = parse_number(trim(length), millimetres) == NumberStatus::ok;
  if (!parsed || millimetres < 1e-3 || millimetres > 1e6) {
    p.error(kFocalLength.name, fmt::format("'focal_length' is {}", quoted(text)),
            "a length from 0.001mm to 1000000mm, such as 50mm");
    millimetres = 50;
  }
  return 2 * std::atan(kFilmDiagonal / (2 * millimetres));
}

/// Half the image's width at distance 1, by `fov` and `fov_axis` or by `focal_length`; `aspect` is width over height.
inline double half_width_of_view(Parameters& p, double aspect) {
  Span axis = p.read(kFovAxis);
  const double degrees = p.read(kFov);
  double angle = focal_length_angle(p);
  if (!p.has(kFov.name)) {
    axis = Span::diagonal;
  } else {
    angle = glm::radians(degrees);
    if (p.has(kFocalLength.name)) {
      p.error(kFocalLength.name,
              fmt::format("{} '{}' has both 'fov' and 'focal_length'", p.node().kind, p.node().plugin), "one of them");
    }
  }
  const double half = std::tan(angle / 2);
  if (axis == Span::smaller) axis = aspect > 1 ? Span::y : Span::x;
  if (axis == Span::larger) axis = aspect > 1 ? Span::x : Span::y;
  if (axis == Span::y) return half * aspect;
  if (axis == Span::diagonal) return half / std::sqrt(1 + 1 / (aspect * aspect));
  return half;
}

/// Whether a transformation is made of rotations and reflections.
inline bool keeps_lengths(const glm::dmat3& linear) {
  const glm::dmat3 gram = glm::transpose(linear) * linear;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(gram[i][j] - (i == j)) > 1e-3) return false;
    }
  }
  return true;
}

}  // namespace norrsken
