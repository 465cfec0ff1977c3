// moment: another integrator's image, with its mean in CIE XYZ and the mean of the samples' squares, channel by channel,
// as layers: of a nested integrator NAME, NAME.X, NAME.Y, NAME.Z and m2_NAME.X, m2_NAME.Y, m2_NAME.Z. The name of one
// that has none is _arg_0, as in Mitsuba.
//
// Children: integrator (exactly one; Mitsuba takes several).
// Departures: an `aov` inside is refused: put `aov` around `moment`.
#include "integrator/integrator_host.h"

namespace norrsken {

IntegratorSettings compile_integrator_moment(Parameters& p, Integrators& integrators) {
  const NestedIntegrator nested = read_nested_integrator(p, integrators);
  if (nested.plugin.empty()) {
    p.error("", "integrator 'moment' has no integrator in it", "<integrator type=\"path\"/> in it");
  } else if (!integrators.layers().features.empty() || !integrators.layers().moments.empty()) {
    p.error("", "integrator 'moment' has an integrator with layers in it", "direct, path, whitted or depth in it");
  }
  if (nested.settings.from_lights) {
    p.error("", "integrator 'moment' has 'ptracer' in it, whose samples have no pixel of their own",
            "direct, path, whitted or depth in it");
  }
  integrators.layers().moments.push_back(nested.name);
  return nested.settings;
}

}  // namespace norrsken
