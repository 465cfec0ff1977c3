// direct: emitters and the light that comes from them straight to what is seen, by sampling emitters and the BSDFs.
//
// Source: Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation, equation 9.13: the power heuristic with
// numbers of samples.
// Departures: max_depth and bounces are ours.
#include "integrator/integrator_host.h"

namespace norrsken {
namespace {

constexpr IntegerParameter kShadingSamples{.name = "shading_samples",
                                           .fallback = 1,
                                           .min = 1,
                                           .max = kMaxShadingSamples,
                                           .text = "sets both emitter_samples and bsdf_samples"};
constexpr IntegerParameter kEmitterSamples{.name = "emitter_samples",
                                           .fallback = 1,
                                           .min = 0,
                                           .max = kMaxShadingSamples,
                                           .text = "shadow rays per camera ray",
                                           .in_place_of = "shading_samples"};
constexpr IntegerParameter kBsdfSamples{.name = "bsdf_samples",
                                        .fallback = 1,
                                        .min = 0,
                                        .max = kMaxShadingSamples,
                                        .text =
                                            "directions sampled from the BSDF per camera ray; the two may not both be "
                                            "0. Without emitter samples point-like "
                                            "lights are not seen, without BSDF samples mirrors are black",
                                        .in_place_of = "shading_samples"};

}  // namespace

IntegratorSettings compile_integrator_direct(Parameters& p, Integrators&) {
  const std::int64_t both = p.read(kShadingSamples);
  const auto emitter_samples = static_cast<int>(p.read(kEmitterSamples.or_else(both)));
  const auto bsdf_samples = static_cast<int>(p.read(kBsdfSamples.or_else(both)));
  if (p.has(kShadingSamples.name) && (p.has(kEmitterSamples.name) || p.has(kBsdfSamples.name))) {
    p.error(kShadingSamples.name, "'shading_samples' is given besides 'emitter_samples' or 'bsdf_samples'",
            "shading_samples alone, or the other two");
  }
  if (emitter_samples + bsdf_samples == 0) {
    p.error(kBsdfSamples.name, "'emitter_samples' and 'bsdf_samples' are both 0", "at least one of them above 0");
  }
  IntegratorSettings settings = read_path_lengths(p);
  if (settings.max_depth < 0 || settings.max_depth > 2) settings.max_depth = 2;
  settings.emitter_samples = emitter_samples;
  settings.bsdf_samples = bsdf_samples;
  settings.hide_emitters = p.read(kHideEmitters);
  return settings;
}

}  // namespace norrsken
