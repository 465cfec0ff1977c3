// stratified: one point in each cell of a grid. It gets the Sobol' points, which are that and more: they are stratified
// for every power of two of samples, in both coordinates alone and together.
//
// Departures: sample_count is not rounded up to a square number.
#include "compile/frame_tools.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_stratified(Parameters& p) {
  p.read(kJitter);
  return read_sampler(p, SamplerKind::sobol);
}

}  // namespace norrsken
