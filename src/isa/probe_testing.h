// Single stages and bare intersection and sampling, for tests on made-up queues and for benchmarks: compiled per instruction
// set as the kernels are, into objects that the product does not have.
#pragma once

#include "isa/entry.h"

namespace norrsken {

/// Beside the KernelEntry of the same name.
struct KernelProbe {
  const char* name;

  void (*generate_camera_rays)(const SceneView&, const WaveJob&, Queue<stored::Slot>&, Queue<stored::Ray>&);
  void (*skip_emitters)(const SceneView&, Queue<stored::Ray>&);
  void (*intersect_closest)(const SceneView&, bool from_camera, std::uint32_t wanted_kinds, const Queue<stored::Ray>&,
                            Queue<stored::Slot>&, FoundQueues&);
  void (*intersect_emitters)(const SceneView&, const Queue<stored::Ray>&, Queue<stored::Slot>&, FoundQueues&);
  void (*intersect_shadow)(const SceneView&, const Queue<stored::ShadowRay>&, Queue<stored::Slot>&);
  void (*shade_emission)(const SceneView&, const Queue<stored::Hit>& light_hits, Queue<stored::Slot>&);
  void (*shade_miss)(const SceneView&, const Queue<stored::Ray>& misses, Queue<stored::Slot>&);
  /// All hits of one BSDF kind, diffuse or conductor, at bounce `hit_number`, with light sampling and next rays; roulette
  /// if asked for.
  void (*shade_surface)(const SceneView&, BsdfKind, std::uint32_t hit_number, bool roulette, const Queue<stored::Hit>&,
                        const Queue<stored::Slot>&, Queue<stored::ShadowRay>&, Queue<stored::Ray>& next_rays);

  /// t is infinite and primitive kNone where nothing was hit; bit 31 of `primitive_side` marks the back.
  void (*closest_rays)(const SceneView&, bool coherent, const RayArrays&, float* t, std::uint32_t* primitive_side);
  /// One 2D point for each pixel of [0, count): out x and y.
  void (*sample_2d)(SamplerKind, std::uint64_t seed, std::uint32_t sample, std::uint32_t dimension, std::uint32_t count,
                    float* x, float* y);
};

/// Of that instruction set, which was built.
const KernelProbe& probe_of(const KernelEntry& kernels);

}  // namespace norrsken
