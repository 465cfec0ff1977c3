// orthogonal: points from orthogonal arrays, stratified in several coordinates at once. It gets the Sobol' points, whose
// pairs of coordinates are nets and whose pairs are independent of each other.
//
// Parameters: those of all samplers (sampler/sampler_host.h), and
//   strength  integer, 2 to 1024 (default 2): how many coordinates are stratified together; the Sobol' points are what
//             they are, so it changes nothing
//   jitter    boolean (default true): whether points move within their cells; they always do, so it changes nothing
// Departures: sample_count is not rounded up to a power of a prime; any strength beyond 2 means 2.
#include "compile/plugins.h"
#include "sampler/sampler_host.h"

namespace norrsken {

SamplerSettings compile_sampler_orthogonal(Parameters& p, Builder&) {
  p.integer("strength", 2, 2, 1024);
  p.boolean("jitter", true);
  return read_sampler(p, SamplerKind::sobol);
}

}  // namespace norrsken
