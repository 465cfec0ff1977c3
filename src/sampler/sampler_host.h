// What all samplers are told.
#pragma once

#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

SamplerSettings read_sampler(Parameters& p, SamplerKind kind);

}  // namespace norrsken
