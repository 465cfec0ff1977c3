// Heat maps of cells, for those who have to find out why a chi-square failed.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tests/statistics/chi_square.h"

namespace norrsken::statistics {

/// An SVG document: density expected and density found on one scale, and the difference in standard deviations; the
/// caption, line by line, above them.
std::string heat_maps_svg(std::span<const Cell> cells, const std::array<std::string, 2>& axes,
                          const std::vector<std::string>& caption);

/// Writes the document into the folder that the environment variable NORRSKEN_TEST_PLOTS names, else into the build's
/// `plots`, as NAME-N.svg with letters and digits of `name` and the first N that is free in this process. Returns the
/// path, or what went wrong.
std::string save_plot(const std::string& name, const std::string& svg);

}  // namespace norrsken::statistics
