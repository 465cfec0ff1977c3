// depth: the distance from the camera to what it sees, in scene units, in R, G and B alike; 0 where it sees nothing.
// No parameters.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_depth(Parameters&, Integrators&) {
  IntegratorSettings settings;
  settings.distance = true;
  return settings;
}

}  // namespace norrsken
