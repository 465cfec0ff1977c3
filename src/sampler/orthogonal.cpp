// orthogonal: points from orthogonal arrays, stratified in several coordinates at once. It gets the Sobol' points, whose
// pairs of coordinates are nets and whose pairs are independent of each other.
//
// Departures: sample_count is not rounded up to a power of a prime; any strength beyond 2 means 2.
#include "compile/frame_tools.h"
#include "sampler/sampler_host.h"

namespace norrsken {
namespace {

constexpr IntegerParameter kStrength{.name = "strength",
                                     .fallback = 2,
                                     .min = 2,
                                     .max = 1024,
                                     .text =
                                         "how many coordinates are stratified together; the Sobol' points are what "
                                         "they are, so it changes nothing"};

}  // namespace

SamplerSettings compile_sampler_orthogonal(Parameters& p) {
  p.read(kStrength);
  p.read(kJitter);
  return read_sampler(p, SamplerKind::sobol);
}

}  // namespace norrsken
