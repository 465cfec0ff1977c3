// rayleigh: host side.
#include "medium/rayleigh.h"

#include "compile/media.h"

namespace norrsken {

PhaseWord compile_phase_rayleigh(Parameters&, Media& media) { return media.add(isa_host::Rayleigh::Stored{}); }

}  // namespace norrsken
