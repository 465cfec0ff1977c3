// Every scattering model and every kind of light on arrays, compiled once per instruction set for bsdf_benchmark and
// emitter_benchmark. Generated from the families' lists: a new model is measured by its line.
#pragma once

#include <cstdint>
#include <vector>

#include "tables/wave_types.h"

namespace norrsken {

enum class BsdfOperation { evaluate, pdf_sa, sample, hit, count };
enum class LightOperation { sample, pdf_sa, count };

/// Arrays of `count` values, padded and aligned as queues are.
struct ModelArrays {
  const SceneView* scene;
  std::uint32_t count;
  const float* place;         ///< of BSDFs the words of their parameters' offsets, of lights those of their indices
  const float *wo[3], *u[3];  ///< u: two numbers that choose a direction or a point, one that chooses a lobe
  const float* wi[3];
  const float *reference[3], *distance;  ///< lights: where from, and how far along `wi` the light is
  float* out[8];
};

/// Every operation looks up the parameters of each path, as the renderer does.
struct ModelKernels {
  using Kernel = void (*)(const ModelArrays&);

  const char* name;  ///< the instruction set's
  std::uint32_t lanes;
  /// evaluate: 3 values out; pdf_sa: 1; sample: direction, weight, density and eta, 8 values; hit: what next-event
  /// estimation and the next ray ask of a model together. Null for what a delta model is never asked.
  Kernel bsdf[kModelCount][static_cast<int>(BsdfOperation::count)];
  /// sample: point, density and radiance, 7 values; pdf_sa: 1, null for delta lights.
  Kernel light[static_cast<int>(LightKind::count)][static_cast<int>(LightOperation::count)];
};

/// Of the sets that were built and that this processor can run, best first.
std::vector<const ModelKernels*> usable_model_kernels();

}  // namespace norrsken
