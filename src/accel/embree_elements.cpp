#include "accel/embree_elements.h"

#include "shape/cylinder.h"
#include "shape/disk.h"

namespace norrsken {

bool has_elements(AnalyticKind kind) {
  switch (kind) {
#define NORRSKEN_ANALYTIC(name, Model) \
  case AnalyticKind::name:             \
    return isa_host::kHasElements<isa_host::Model>;
#include "shape/list.def"
#undef NORRSKEN_ANALYTIC
    case AnalyticKind::count:
      break;
  }
  return false;
}

RTCGeometry make_embree_elements(RTCDevice /*device*/, const SceneTables& /*scene*/, const AnalyticRecord& /*shape*/) {
  return nullptr;  // no kind has any yet
}

}  // namespace norrsken
