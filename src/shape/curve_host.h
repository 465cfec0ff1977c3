// What the hosts of the curve shapes share: placing, and the table that src/shape/curve.h reads.
#pragma once

#include <optional>

#include "compile/builder.h"
#include "formats/curves.h"

namespace norrsken {

/// A shape of the curves in the file that its parameters name.
std::optional<ShapeGeometry> compile_curves(Parameters& p, Builder& builder, AnalyticKind kind, CurveBasis basis);

}  // namespace norrsken
