// What all samplers are told.
#pragma once

#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// Of points in cells.
inline constexpr BooleanParameter kJitter{
    .name = "jitter",
    .fallback = true,
    .text = "whether points move within their cells; they always do, so it changes nothing"};

SamplerSettings read_sampler(Parameters& p, SamplerKind kind);

}  // namespace norrsken
