#include "integrator/integrator_host.h"

#include <limits>

namespace norrsken {

IntegratorSettings read_path_lengths(Parameters& p) {
  constexpr int kMax = std::numeric_limits<int>::max();
  IntegratorSettings settings;
  settings.max_depth = static_cast<int>(p.integer("max_depth", -1, -1, kMax));
  const int bounces = static_cast<int>(p.integer("bounces", -1, 0, kMax - 1));
  if (p.has("bounces")) {
    if (p.has("max_depth")) p.error("bounces", "both 'bounces' and 'max_depth' are given", "one of them");
    settings.max_depth = bounces + 1;
  }
  settings.rr_depth = static_cast<int>(p.integer("rr_depth", 5, 1, kMax));
  return settings;
}

IntegratorSettings read_integrator(Parameters& p) {
  IntegratorSettings settings = read_path_lengths(p);
  settings.emitter_samples = static_cast<int>(p.integer("emitter_samples", 1, 1, 100000));
  settings.hide_emitters = p.boolean("hide_emitters", false);
  return settings;
}

}  // namespace norrsken
