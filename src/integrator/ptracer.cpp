// ptracer: light tracing. Paths start at the lights, and every surface that they meet is connected to the camera: what
// path finds by chance, such as the light of a small lamp through glass, is found with ease, and the other way round.
// Both have the same image in the limit, except that mirrors and smooth glass before the camera stay black: no path
// from a light can be made to reach the camera by way of them.
//
// Departures: emitters that the camera sees are sampled by its own rays, which leaves no noise in them.
//
// Limits: with `flip_invalid_normals` (normalmap, bumpmap) normals that turn away are folded back by where the light is, as in
// Mitsuba, where `path` folds them by the viewer. Where many are folded the two have different images, which a warning
// says: 1.3 to 1.5 times as bright on a sphere with slopes of up to 80 degrees, there and here.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_ptracer(Parameters& p, Integrators&) {
  IntegratorSettings settings = read_path_lengths(p);
  settings.hide_emitters = p.read(kHideEmitters);
  settings.from_lights = true;
  return settings;
}

}  // namespace norrsken
