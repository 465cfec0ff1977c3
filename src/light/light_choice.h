// How next-event estimation chooses among lights.
#pragma once

#include <span>

#include "tables/scene_tables.h"

namespace norrsken {

/// Power of a light in the sense of luminance: pi A L for a surface that emits radiance L to one side, 4 pi I for a
/// point of radiant intensity I.
double light_power(const LightRecord& light);

/// Fills `prob`, `alias_prob` and `alias` of every record so that a light is chosen with probability proportional to
/// its power; uniformly if none has any.
///
/// Source: Vose 1991, A Linear Algorithm for Generating Random Numbers with a Given Distribution.
void choose_lights_by_power(std::span<LightRecord> lights);

}  // namespace norrsken
