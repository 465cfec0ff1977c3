// sobol: Owen-scrambled Sobol' points, the sampler of scenes that name none.
//
// Departures: Mitsuba has no sampler of this name; its default is `independent`.
#include "compile/frame_tools.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_sobol(Parameters& p) { return read_sampler(p, SamplerKind::sobol); }

}  // namespace norrsken
