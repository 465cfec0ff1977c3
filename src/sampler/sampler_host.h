// What all samplers are told.
//
// Parameters
//   sample_count  integer, 1 to 2^31 - 1 (default 4): samples per pixel
//   seed          integer, at least 0 (default 0): another seed gives other noise
#pragma once

#include <cstdint>
#include <limits>

#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// Samples per pixel fit an int.
inline constexpr std::int64_t kMaxSampleCount = std::numeric_limits<std::int32_t>::max();

SamplerSettings read_sampler(Parameters& p, SamplerKind kind);

}  // namespace norrsken
