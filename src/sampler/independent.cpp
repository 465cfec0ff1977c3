// independent: uniform random numbers that know nothing of each other.
#include "compile/frame_tools.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_independent(Parameters& p) { return read_sampler(p, SamplerKind::independent); }

}  // namespace norrsken
