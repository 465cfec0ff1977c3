// What all integrators are told: settings of one loop.
//
// Parameters
//   max_depth        integer, -1 (default: no limit) or at least 0: 1 shows emitters only, 2 adds direct light, ...
//   bounces          integer, at least 0, in place of max_depth: surfaces that a path is scattered by at most, which is
//                    max_depth - 1
//   rr_depth         integer, at least 1 (default 5): depth from which Russian roulette ends paths
//   emitter_samples  integer, 1 to 100000 (default 1): shadow rays per hit
//   hide_emitters    boolean (default false): emitters are not seen by the camera itself
// Departures: `bounces` is ours, and so is emitter_samples where Mitsuba has it for `direct` alone.
#pragma once

#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

IntegratorSettings read_integrator(Parameters& p);

/// max_depth, bounces and rr_depth alone.
IntegratorSettings read_path_lengths(Parameters& p);

}  // namespace norrsken
