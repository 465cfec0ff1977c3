#include "accel/embree_elements.h"

#include "accel/embree_curves.h"
#include "accel/embree_grid.h"
#include "shape/models.h"

namespace norrsken {

bool has_elements(AnalyticKind kind) {
  switch (kind) {
#define NORRSKEN_ANALYTIC(name, Model) \
  case AnalyticKind::name:             \
    return isa_host::kHasElements<isa_host::Model>;
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC
    case AnalyticKind::count:
      break;
  }
  return false;
}

RTCGeometry make_embree_elements(RTCDevice device, const ElementShape& shape) {
  switch (shape.record->kind) {
    case AnalyticKind::bsplinecurve:
      return make_embree_bspline_curves(device, shape);
    case AnalyticKind::linearcurve:
      return make_embree_linear_curves(device, shape);
    case AnalyticKind::sdfgrid:
      return make_embree_grid(device, shape);
    default:
      return nullptr;  // made of one piece
  }
}

}  // namespace norrsken
