// The one door between host and kernels: a table of functions per instruction set.
#pragma once

#include <cstdint>

#include "tables/film_view.h"
#include "tables/wave_types.h"

namespace norrsken {

/// Rays for tests and benchmarks: arrays of `count` values, padded and aligned as queues are.
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
  void (*accumulate_film)(const WaveJob&, SamplerKind, const Queue& slots, const FilmView&, DroppedSamples&);
  void (*accumulate_features)(const WaveJob&, const Queue& slots, const FilmView&);

  // Single stages, for tests on made-up queues and for benchmarks.
  void (*generate_camera_rays)(const SceneView&, const WaveJob&, Queue& slots, Queue& rays);
  /// These two fill the memory's hits, light hits and misses.
  void (*intersect_closest)(const SceneView&, std::uint32_t hit_number, std::uint32_t wanted_kinds, const Queue& rays,
                            WaveMemory&);
  void (*intersect_emitters)(const SceneView&, const Queue& rays, WaveMemory&);
  void (*intersect_shadow)(const SceneView&, const Queue& shadow_rays, Queue& slots);
  void (*shade_emission)(const SceneView&, const Queue& light_hits, Queue& slots);
  void (*shade_miss)(const SceneView&, const Queue& misses, Queue& slots);
  /// All hits of one BSDF kind at bounce `hit_number`, with light sampling and next rays; roulette if asked for.
  void (*shade_surface)(const SceneView&, BsdfKind, std::uint32_t hit_number, bool roulette, const Queue& hits,
                        const Queue& slots, Queue& shadow_rays, Queue& next_rays);

  // Bare intersection and sampling.
  /// t is infinite and primitive kNone where nothing was hit; bit 31 of `primitive_side` marks the back.
  void (*closest_rays)(const SceneView&, bool coherent, const RayArrays&, float* t, std::uint32_t* primitive_side);
  void (*occluded_rays)(const SceneView&, const RayArrays&, const float* t_max, std::uint8_t* occluded);
  /// One 2D point for each pixel of [0, count): out x and y.
  void (*sample_2d)(SamplerKind, std::uint64_t seed, std::uint32_t sample, std::uint32_t dimension, std::uint32_t count,
                    float* x, float* y);
};

/// An instruction set that was built and that this processor can run, by name ("avx512", "avx2", "sse4.2" or "neon",
/// "scalar"), or null. "auto" is the best one.
const KernelEntry* find_kernels(const char* name);

/// Usable sets, best first; ends with null.
const KernelEntry* const* usable_kernels();

}  // namespace norrsken
