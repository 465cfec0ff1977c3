// box: every sample counts for the pixel that it falls into, all alike. No parameters.
#include "compile/frame_tools.h"

namespace norrsken {

FilterRecord compile_rfilter_box(Parameters&, Array<float>&) { return {}; }

}  // namespace norrsken
