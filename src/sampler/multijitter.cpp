// multijitter: correlated multi-jittered points, stratified in a grid and in both coordinates alone. It gets the Sobol'
// points, which are that and more: nets, stratified in cells of every shape.
//
// Parameters: those of all samplers (sampler/sampler_host.h), and
//   jitter  boolean (default true): whether points move within their cells; they always do, so it changes nothing
// Departures: sample_count is not rounded up to a product of the grid's sides.
#include "compile/plugins.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_multijitter(Parameters& p, Builder&) {
  p.boolean("jitter", true);
  return read_sampler(p, SamplerKind::sobol);
}

}  // namespace norrsken
