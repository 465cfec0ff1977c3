// What the hosts of the curve shapes share: placing, and the table that src/shape/curve.h reads.
#pragma once

#include <optional>

#include "compile/shapes.h"
#include "formats/curves.h"

namespace norrsken {

/// A shape of the curves in the file that its parameters name.
std::optional<ShapeGeometry> compile_curves(Parameters& p, Shapes& shapes, const FileParameter& filename,
                                            AnalyticKind kind, CurveBasis basis);

}  // namespace norrsken
