// The one door between host and kernels: a table of functions per instruction set.
#pragma once

#include <cstdint>

#include "tables/film_view.h"
#include "tables/wave_types.h"

namespace norrsken {

/// Rays with an end: arrays of `count` values, padded and aligned as queues are.
struct RayArrays {
  const float *ox, *oy, *oz, *dx, *dy, *dz;
  std::uint32_t count;
};

/// Every function is compiled for one instruction set; arguments are plain tables.
struct KernelEntry {
  const char* name;  ///< as on the command line: "avx512"
  std::uint32_t lanes;

  // Whole waves: what a worker calls.
  void (*trace_wave)(const SceneView&, const WaveJob&, WaveMemory&, WaveCounts&);
  void (*trace_features)(const SceneView&, const WaveJob&, WaveMemory&, WaveCounts&);
  /// Paths from the lights: begins at hit number 1, returns 0 when the wave is done, else the hit number to go on with
  /// when the memory's splats have been taken to the film.
  std::uint32_t (*trace_particles)(const SceneView&, const WaveJob&, std::uint32_t hit_number, WaveMemory&,
                                   WaveCounts&);
  /// Samples that are not finite are set to zero in the slots.
  void (*accumulate_film)(const WaveJob&, SamplerKind, Queue<stored::Slot>&, const FilmView&, DroppedSamples&);
  void (*accumulate_features)(const WaveJob&, const Queue<stored::Slot>&, const FilmView&);

  /// For a path that is told vertex by vertex.
  void (*occluded_rays)(const SceneView&, const RayArrays&, const float* t_max, std::uint8_t* occluded);
};

/// An instruction set that was built and that this processor can run, by name ("avx512", "avx2", "sse4.2" or "neon",
/// "scalar"), or null. "auto" is the best one.
const KernelEntry* find_kernels(const char* name);

/// Usable sets, best first; ends with null.
const KernelEntry* const* usable_kernels();

}  // namespace norrsken
