// What a camera and a projector share: how wide they see, and how they may be placed.
#pragma once

#include <fmt/format.h>

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

/// Angle in radians along the film's diagonal.
inline double focal_length_angle(Parameters& p) {
  const std::string text = p.text("focal_length", "50mm");
  constexpr std::string_view kUnit = "mm";
  std::string_view length = text;
  if (length.ends_with(kUnit)) length.remove_suffix(kUnit.size());
  double millimetres = 0;
  const bool parsed = parse_number(trim(length), millimetres) == NumberStatus::ok;
  if (!parsed || millimetres < 1e-3 || millimetres > 1e6) {
    p.error("focal_length", fmt::format("'focal_length' is {}", quoted(text)),
            "a length from 0.001mm to 1000000mm, such as 50mm");
    millimetres = 50;
  }
  return 2 * std::atan(kFilmDiagonal / (2 * millimetres));
}

/// Half the image's width at distance 1, by `fov` and `fov_axis` or by `focal_length`; `aspect` is width over height.
inline double half_width_of_view(Parameters& p, double aspect) {
  std::string axis = p.choice("fov_axis", "x", {"x", "y", "diagonal", "smaller", "larger"});
  const double degrees = p.number("fov", 45, 0, 180, Ends::open);
  double angle = focal_length_angle(p);
  if (!p.has("fov")) {
    axis = "diagonal";
  } else {
    angle = glm::radians(degrees);
    if (p.has("focal_length")) {
      p.error("focal_length", fmt::format("{} '{}' has both 'fov' and 'focal_length'", p.node().kind, p.node().plugin),
              "one of them");
    }
  }
  const double half = std::tan(angle / 2);
  if (axis == "smaller") axis = aspect > 1 ? "y" : "x";
  if (axis == "larger") axis = aspect > 1 ? "x" : "y";
  if (axis == "y") return half * aspect;
  if (axis == "diagonal") return half / std::sqrt(1 + 1 / (aspect * aspect));
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
