// ldsampler: scrambled (0, 2)-sequences. It gets the Sobol' points, whose pairs of coordinates are (0, 2)-sequences too.
//
// Departures: sample_count is not rounded up to a power of two.
#include "compile/frame_tools.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_ldsampler(Parameters& p) { return read_sampler(p, SamplerKind::sobol); }

}  // namespace norrsken
