// volpathmis: volpath with multiple importance sampling over the spectrum. Where there is no medium, and media are not
// supported yet, that is `path`, and so it is rendered.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_volpathmis(Parameters& p, Integrators&) { return read_volume_integrator(p); }

}  // namespace norrsken
