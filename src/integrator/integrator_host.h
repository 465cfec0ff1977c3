// What all integrators that follow paths are told: settings of one loop.
//
// Departures: `bounces` is ours, and so is emitter_samples where Mitsuba has it for `direct` alone.
#pragma once

#include <string>

#include "compile/frame_tools.h"

namespace norrsken {

inline constexpr int kMaxShadingSamples = 100000;
inline constexpr BooleanParameter kHideEmitters{
    .name = "hide_emitters",
    .text =
        "the camera does not see emitters themselves: it looks through surfaces that emit, and sees no environment"};

IntegratorSettings read_integrator(Parameters& p);

/// For those whose paths are scattered by media, too.
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
NestedIntegrator read_nested_integrator(Parameters& p, Integrators& integrators);

}  // namespace norrsken
