#include "shape/analytic_host.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace norrsken {

std::optional<ShapeGeometry> place_analytic(const AnalyticShape& shape, Parameters& p) {
  for (int axis = 0; axis < 3; ++axis) {
    double extent = 0;
    for (int column = 0; column < 4; ++column) extent += std::abs(shape.world_from_local[column][axis]);
    if (extent <= kMaxCoordinate) continue;
    p.error("to_world", fmt::format("the {} is placed too far away or made too large", p.node().plugin),
            fmt::format("coordinates up to {:g}", kMaxCoordinate));
    return std::nullopt;
  }
  if (!std::isnormal(static_cast<float>(shape.area))) return nothing_to_draw(p, "area", shape.area);
  ShapeGeometry geometry;
  geometry.analytic = shape;
  return geometry;
}

ShapeGeometry nothing_to_draw(Parameters& p, std::string_view measure, double value) {
  p.diagnostics().warning(p.node().location,
                          fmt::format("the {}'s {} of {:g} is too small to be told from 0: nothing of it is drawn",
                                      p.node().plugin, measure, value));
  return {};
}

bool keeps_shape(double deviation, double scale, Parameters& p, std::string_view message, std::string_view accepted) {
  // Half a unit of the last decimal in each element: twice that in a product of two, for up to three of them.
  constexpr double kPrinted = 0.5e-6 * 2 * 3;
  // A matrix written out by hand with ten digits, or a chain of rotations.
  constexpr double kRounding = 1e-5;
  constexpr double kMost = 2e-2;  // of a square: a percent of the scale
  if (!(deviation <= kMost)) {
    p.error("to_world", std::string(message), std::string(accepted));
    return false;
  }
  if (deviation > std::max(kRounding, kPrinted / scale)) {
    p.diagnostics().warning(p.where("to_world"),
                            fmt::format("{}: by up to {:.2g} %, which is left out", message, 50 * deviation),
                            std::string(accepted));
  }
  return true;
}

}  // namespace norrsken
