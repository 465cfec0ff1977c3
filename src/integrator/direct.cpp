// direct: emitters and the light that comes from them straight to what is seen.
//
// Parameters: those of all integrators (integrator/integrator_host.h). Paths end at depth 2 at the latest, so a larger
// max_depth (or none) means 2.
#include "compile/plugins.h"
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_direct(Parameters& p) {
  IntegratorSettings settings = read_integrator(p);
  if (settings.max_depth < 0 || settings.max_depth > 2) settings.max_depth = 2;
  return settings;
}

}  // namespace norrsken
