#include "sampler/sampler_host.h"

#include <limits>

namespace norrsken {

SamplerSettings read_sampler(Parameters& p, SamplerKind kind) {
  SamplerSettings settings;
  settings.kind = kind;
  settings.samples_per_pixel = p.integer("sample_count", 4, 1, kMaxSampleCount);
  settings.seed = static_cast<std::uint64_t>(p.integer("seed", 0, 0, std::numeric_limits<std::int64_t>::max()));
  return settings;
}

}  // namespace norrsken
