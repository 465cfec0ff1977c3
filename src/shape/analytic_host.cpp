#include "shape/analytic_host.h"

#include <fmt/format.h>

#include <cmath>

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
  if (!std::isnormal(static_cast<float>(shape.area))) {
    p.error("to_world",
            fmt::format("the {}'s area of {:g} is too small to be told from 0", p.node().plugin, shape.area));
    return std::nullopt;
  }
  ShapeGeometry geometry;
  geometry.analytic = shape;
  return geometry;
}

}  // namespace norrsken
