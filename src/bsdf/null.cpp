// null: host side.
//
// Departures: emitters on such surfaces are seen wherever they are, as by Mitsuba's `volpath` and `direct`. Its `path` sees
// them before and in other surfaces (a wall, a mirror), too, but makes a path black as a whole that ends without having met
// any: a lamp of radiance 1 is 1 before a wall or an environment and at max_depth 1, and 0 before nothing.
#include "compile/materials.h"

namespace norrsken {

Material compile_bsdf_null(Parameters& p, Materials& materials) {
  materials.describe(p.node(), {});
  const MaterialWord word = materials.add(BsdfKind::null);
  return {.front = word, .back = word};
}

}  // namespace norrsken
