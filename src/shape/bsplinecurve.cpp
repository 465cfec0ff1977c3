// bsplinecurve: any number of uniform cubic B-splines with a radius at each control point: tubes, open at their ends.
//
// A curve goes near its control points, not through them, and begins and ends close to the second and the last but one.
// The radius is interpolated as the place is; a control point's may be negative if the curve's is not, so that a curve can
// end in a point, but it has to be smaller than the curve's radius of curvature. u is the angle around the curve in turns, v
// goes through all segments of the file. Normals point outwards; a curve is not hit from inside.
// Departures: curves with a negative radius are errors, Mitsuba takes them; what stands behind the fourth number of a line
// is left out as in Mitsuba, but with a warning. As a light, a curve is found by rays alone: path renders it, noisily if it
// is thin, and ptracer does not.
#include "shape/curve_host.h"

namespace norrsken {
namespace {

constexpr FileParameter kFilename{.name = "filename",
                                  .text =
                                      "a text file: a control point a line, as four numbers: x y z radius (scene "
                                      "units); empty lines stand between curves, of 4 control points or more each"};

}  // namespace

std::optional<ShapeGeometry> compile_shape_bsplinecurve(Parameters& p, Shapes& shapes) {
  return compile_curves(p, shapes, kFilename, AnalyticKind::bsplinecurve, CurveBasis::bspline);
}

}  // namespace norrsken
