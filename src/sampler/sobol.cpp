// sobol: Owen-scrambled Sobol' points, the sampler of scenes that name none.
//
// Parameters: those of all samplers (sampler/sampler_host.h).
// Departures: Mitsuba has no sampler of this name; its default is `independent`.
#include "compile/plugins.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_sobol(Parameters& p, Builder&) { return read_sampler(p, SamplerKind::sobol); }

}  // namespace norrsken
