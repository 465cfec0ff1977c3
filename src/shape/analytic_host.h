// What shapes with a formula of their own share when they are placed.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <string_view>

#include "compile/shape_geometry.h"
#include "scene/parameters.h"

namespace norrsken {

/// The shape, or a complaint about coordinates out of range. One whose area is not told from 0 is empty, with a warning.
std::optional<ShapeGeometry> place_analytic(const AnalyticShape& shape, Parameters& p);

/// An empty shape, and a warning that tells which measure of it is none.
ShapeGeometry nothing_to_draw(Parameters& p, std::string_view measure, double value);

/// Whether `to_world` keeps the shape what it is: `deviation` is how far the squares of its scale factors, or the cosines
/// of its axes, are off, relative. What six printed decimals of a matrix of scale `scale` leave is taken in silence, up to
/// a percent with a warning; the rest is a complaint.
bool keeps_shape(double deviation, double scale, Parameters& p, std::string_view message, std::string_view accepted);

}  // namespace norrsken
