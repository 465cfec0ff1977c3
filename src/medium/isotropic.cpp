// isotropic: host side.
#include "medium/isotropic.h"

#include "compile/media.h"

namespace norrsken {

PhaseWord compile_phase_isotropic(Parameters&, Media& media) { return media.add(isa_host::Isotropic::Stored{}); }

}  // namespace norrsken
