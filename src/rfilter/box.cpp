// box: every sample counts for the pixel that it falls into, all alike. No parameters.
#include "compile/plugins.h"

namespace norrsken {

FilterRecord compile_rfilter_box(Parameters&, Builder&) { return {}; }

}  // namespace norrsken
