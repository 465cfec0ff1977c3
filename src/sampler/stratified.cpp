// stratified: one point in each cell of a grid. It gets the Sobol' points, which are that and more: they are stratified
// for every power of two of samples, in both coordinates alone and together.
//
// Parameters: those of all samplers (sampler/sampler_host.h), and
//   jitter  boolean (default true): whether points move within their cells; they always do, so it changes nothing
// Departures: sample_count is not rounded up to a square number.
#include "compile/plugins.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_stratified(Parameters& p, Builder&) {
  p.boolean("jitter", true);
  return read_sampler(p, SamplerKind::sobol);
}

}  // namespace norrsken
