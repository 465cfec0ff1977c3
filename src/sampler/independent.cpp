// independent: uniform random numbers that know nothing of each other.
//
// Parameters: those of all samplers (sampler/sampler_host.h).
#include "compile/plugins.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_independent(Parameters& p, Builder&) {
  return read_sampler(p, SamplerKind::independent);
}

}  // namespace norrsken
