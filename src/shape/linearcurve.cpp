// linearcurve: any number of chains of straight segments with a radius at each control point, their joints and ends round.
//
// u is the angle around the segment in turns, v goes through all segments of the file. Normals point outwards; a curve is
// not hit from inside.
// Departures: negative radii are errors, Mitsuba takes them; what stands behind the fourth number of a line is left out as
// in Mitsuba, but with a warning. dp_du and dp_dv are those of u and v, Mitsuba 3.9 has none. Rays exactly along a segment
// that does not swell meet its ends, in Mitsuba they miss it. As a light, a curve is found by rays alone: path renders it,
// noisily if it is thin, and ptracer does not.
#include "shape/curve_host.h"

namespace norrsken {
namespace {

constexpr FileParameter kFilename{
    .name = "filename",
    .text =
        "a text file: a control point a line, as four numbers: x y z radius (scene units, radius at least 0); empty "
        "lines stand between curves, of 2 control points or more each"};

}  // namespace

std::optional<ShapeGeometry> compile_shape_linearcurve(Parameters& p, Shapes& shapes) {
  return compile_curves(p, shapes, kFilename, AnalyticKind::linearcurve, CurveBasis::linear);
}

}  // namespace norrsken
