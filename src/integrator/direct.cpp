// direct: emitters and the light that comes from them straight to what is seen, by sampling emitters and the BSDFs.
//
// Parameters
//   shading_samples  integer, 1 to 100000 (default 1): sets both of the following
//   emitter_samples  integer, 0 to 100000 (default: shading_samples): shadow rays per camera ray
//   bsdf_samples     integer, 0 to 100000 (default: shading_samples): directions sampled from the BSDF per camera ray; the
//                    two may not both be 0. Without emitter samples point-like lights are not seen, without BSDF samples
//                    mirrors are black.
//   max_depth, bounces  as for `path`; more than 2 means 2
//   rr_depth         as for `path`; it changes nothing
//   hide_emitters    as for `path`
// Source: Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation, equation 9.13: the power heuristic with
// numbers of samples.
// Departures: max_depth and bounces are ours.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_direct(Parameters& p, Builder&) {
  const std::int64_t both = p.integer("shading_samples", 1, 1, kMaxShadingSamples);
  const auto emitter_samples = static_cast<int>(p.integer("emitter_samples", both, 0, kMaxShadingSamples));
  const auto bsdf_samples = static_cast<int>(p.integer("bsdf_samples", both, 0, kMaxShadingSamples));
  if (p.has("shading_samples") && (p.has("emitter_samples") || p.has("bsdf_samples"))) {
    p.error("shading_samples", "'shading_samples' is given besides 'emitter_samples' or 'bsdf_samples'",
            "shading_samples alone, or the other two");
  }
  if (emitter_samples + bsdf_samples == 0) {
    p.error("bsdf_samples", "'emitter_samples' and 'bsdf_samples' are both 0", "at least one of them above 0");
  }
  IntegratorSettings settings = read_path_lengths(p);
  if (settings.max_depth < 0 || settings.max_depth > 2) settings.max_depth = 2;
  settings.emitter_samples = emitter_samples;
  settings.bsdf_samples = bsdf_samples;
  settings.hide_emitters = p.boolean("hide_emitters", false);
  return settings;
}

}  // namespace norrsken
