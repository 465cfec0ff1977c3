// volpath: path tracing through participating media, with next-event estimation through whatever light passes straight
// through: boundaries of media (`null`), masks, thin sheets of glass.
//
// Being scattered by a medium counts as depth, as does a surface; passing straight on does not. Where extinction differs by
// channel, distances are drawn for one channel at a time, by what each carries, and weighted by all of them.
// Source: Kajiya 1986, The Rendering Equation; Veach 1997; null collisions and ratio tracking after Novak, Georgiev, Hanika,
// Jarosz, "Monte Carlo Methods for Volumetric Light Transport Simulation", 2018.
// Departures: homogeneous media are passed in closed form, without noise.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_volpath(Parameters& p, Integrators&) { return read_volume_integrator(p); }

}  // namespace norrsken
