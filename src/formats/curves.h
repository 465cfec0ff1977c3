// Reader for the text files of curve shapes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/memory.h"
#include "norrsken/diagnostics.h"

namespace norrsken {

/// How many control points in a row a segment of a curve depends on.
enum class CurveBasis : std::uint32_t { linear = 2, bspline = 4 };

struct CurveData {
  Array<std::array<float, 4>> points;  ///< x, y, z, radius
  Array<std::uint32_t> segments;       ///< the first control point of each
  std::uint32_t curves = 0;
};

/// A control point a line: x y z radius; empty lines stand between curves. Every curve has enough points for a segment,
/// and no radius is negative along it. What follows the fourth number is left out, with a warning.
std::optional<CurveData> read_curves(std::string_view bytes, CurveBasis basis, const std::string& path,
                                     Diagnostics& diagnostics);

}  // namespace norrsken
