// From a filter's formula to the table that kernels sample.
#pragma once

#include <functional>

#include "tables/scene_tables.h"

namespace norrsken {

/// In pixels; a wider filter says nothing about a pixel any more.
inline constexpr double kMaxFilterRadius = 100;

/// An even filter along one axis.
struct FilterFunction {
  std::function<double(double)> value;  ///< at x >= 0
  double radius;                        ///< it is zero from there on
  double step;  ///< in pixels: between nodes the table is linear, its error at most step^2 / 8 times the curvature
};

/// Fills `table`; see src/rfilter/filter.h.
FilterRecord tabulate_filter(const FilterFunction& filter, Array<float>& table);

}  // namespace norrsken
