// path: unidirectional path tracing with next-event estimation and multiple importance sampling.
//
// Source: Kajiya 1986, The Rendering Equation; Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_path(Parameters& p, Integrators&) { return read_integrator(p); }

}  // namespace norrsken
