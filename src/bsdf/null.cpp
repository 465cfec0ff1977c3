// null: host side.
//
// Parameters: none. Nothing is stored.
// Departures: emitters on such surfaces are seen, as by Mitsuba's `volpath` and `direct`; its `path` sees only what they
// light.
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_null(Parameters& p, Builder& builder) {
  builder.describe(p.node(), {});
  const MaterialWord word = builder.add_material(BsdfKind::null, ParameterBlock());
  return {.front = word, .back = word};
}

}  // namespace norrsken
