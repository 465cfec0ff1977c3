#include "sampler/sampler_host.h"

namespace norrsken {
namespace {

constexpr IntegerParameter kSampleCount{
    .name = "sample_count", .fallback = 4, .min = 1, .max = kMaxSampleCount, .text = "samples per pixel"};
constexpr IntegerParameter kSeed{.name = "seed", .fallback = 0, .min = 0, .text = "another seed gives other noise"};

}  // namespace

SamplerSettings read_sampler(Parameters& p, SamplerKind kind) {
  SamplerSettings settings;
  settings.kind = kind;
  settings.samples_per_pixel = p.read(kSampleCount);
  settings.seed = static_cast<std::uint64_t>(p.read(kSeed));
  return settings;
}

}  // namespace norrsken
