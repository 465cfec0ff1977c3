// What all integrators that follow paths are told: settings of one loop.
//
// Parameters
//   max_depth        integer, -1 (default: no limit) or at least 0: 1 shows emitters only, 2 adds direct light, ...
//   bounces          integer, at least 0, in place of max_depth: surfaces that a path is scattered by at most, which is
//                    max_depth - 1
//   rr_depth         integer, at least 1 (default 5): depth from which Russian roulette ends paths
//   emitter_samples  integer, 1 to 100000 (default 1): shadow rays per hit
//   hide_emitters    boolean (default false): the camera does not see emitters themselves: it looks through surfaces that
//                    emit, and sees no environment
// Departures: `bounces` is ours, and so is emitter_samples where Mitsuba has it for `direct` alone.
#pragma once

#include <string>

#include "compile/builder.h"
#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

inline constexpr int kMaxShadingSamples = 100000;

IntegratorSettings read_integrator(Parameters& p);

/// For integrators of volumes, which are path where there is no medium; a note says so.
IntegratorSettings read_volume_integrator(Parameters& p);

/// max_depth, bounces and rr_depth alone.
IntegratorSettings read_path_lengths(Parameters& p);
/// An integrator inside another one, and the name that its layers begin with.
struct NestedIntegrator {
  IntegratorSettings settings;
  std::string name;    ///< Mitsuba's for a child that has none
  std::string plugin;  ///< empty if there is none
  bool has_name = false;
};

/// At most one; what it asks for in layers gets its name in front.
NestedIntegrator read_nested_integrator(Parameters& p, Builder& builder);

}  // namespace norrsken
