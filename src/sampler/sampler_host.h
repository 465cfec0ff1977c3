// What all samplers are told.
//
// Parameters
//   sample_count  integer, 1 to 2^31 - 1 (default 4): samples per pixel
//   seed          integer, at least 0 (default 0): another seed gives other noise
#pragma once

#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

SamplerSettings read_sampler(Parameters& p, SamplerKind kind);

}  // namespace norrsken
