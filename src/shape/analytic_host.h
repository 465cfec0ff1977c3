// What shapes with a formula of their own share when they are placed.
#pragma once

#include <optional>

#include "compile/builder.h"

namespace norrsken {

/// The shape, or a complaint: about coordinates out of range, or an area too small to be told from 0.
std::optional<ShapeGeometry> place_analytic(const AnalyticShape& shape, Parameters& p);

}  // namespace norrsken
