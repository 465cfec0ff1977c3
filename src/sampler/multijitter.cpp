// multijitter: correlated multi-jittered points, stratified in a grid and in both coordinates alone. It gets the Sobol'
// points, which are that and more: nets, stratified in cells of every shape.
//
// Departures: sample_count is not rounded up to a product of the grid's sides.
#include "compile/frame_tools.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_multijitter(Parameters& p) {
  p.read(kJitter);
  return read_sampler(p, SamplerKind::sobol);
}

}  // namespace norrsken
