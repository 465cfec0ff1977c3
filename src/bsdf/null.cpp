// null: host side.
//
// Parameters: none. Nothing is stored.
#include "compile/plugins.h"

namespace norrsken {

Material compile_bsdf_null(Parameters& p, Builder& builder) {
  builder.describe(p.node(), {});
  const MaterialWord word = builder.add_material(BsdfKind::null, ParameterBlock());
  return {.front = word, .back = word};
}

}  // namespace norrsken
