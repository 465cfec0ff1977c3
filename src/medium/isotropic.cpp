// isotropic: host side.
#include "medium/isotropic.h"

#include "compile/media.h"

namespace norrsken {

PhaseWord default_phase(Media& media) { return media.add(isa_host::Isotropic::Stored{}); }

PhaseWord compile_phase_isotropic(Parameters&, Media& media) { return default_phase(media); }

}  // namespace norrsken
