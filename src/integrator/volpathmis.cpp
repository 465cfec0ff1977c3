// volpathmis: `volpath`, which samples all channels of extinction together here, as this integrator is for.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_volpathmis(Parameters& p, Integrators&) { return read_volume_integrator(p); }

}  // namespace norrsken
