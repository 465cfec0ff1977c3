// volpath: path tracing through participating media. Where there is no medium, and media are not supported yet, that is
// `path`, and so it is rendered.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_volpath(Parameters& p, Integrators&) { return read_volume_integrator(p); }

}  // namespace norrsken
