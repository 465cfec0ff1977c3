// box: every sample counts for the pixel that it falls into, all alike. No parameters.
#include "compile/plugins.h"

namespace norrsken {

FilterKind compile_rfilter_box(Parameters&) { return FilterKind::box; }

}  // namespace norrsken
