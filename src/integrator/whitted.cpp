// whitted: recursive ray tracing: mirrors are followed, every other surface shows direct light alone.
//
// Source: Whitted 1980, An Improved Illumination Model for Shaded Display.
// Departures: no ambient term, and lights are sampled, so area lights cast soft shadows.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_whitted(Parameters& p, Integrators&) {
  IntegratorSettings settings = read_integrator(p);
  settings.diffuse_bounces = false;
  return settings;
}

}  // namespace norrsken
