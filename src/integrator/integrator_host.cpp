#include "integrator/integrator_host.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "base/text.h"

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
  settings.emitter_samples = static_cast<int>(p.integer("emitter_samples", 1, 1, kMaxShadingSamples));
  settings.hide_emitters = p.boolean("hide_emitters", false);
  return settings;
}

IntegratorSettings read_volume_integrator(Parameters& p) {
  p.diagnostics().note(
      p.node().plugin_location,
      fmt::format("integrator {} is 'path' here: the same where there is no medium", quoted(p.node().plugin)));
  return read_integrator(p);
}

NestedIntegrator read_nested_integrator(Parameters& p, Builder& builder) {
  NestedIntegrator nested;
  const Node::Child* child = p.child("integrator");
  if (!child) return nested;
  nested.plugin = child->node->plugin;
  nested.has_name = !child->name.empty();
  nested.name = nested.has_name ? child->name : "_arg_0";
  SceneLayers before = std::exchange(builder.layers(), {});
  nested.settings = builder.integrator(*child->node);
  SceneLayers& layers = builder.layers();
  for (FeatureLayer& layer : layers.features) layer.name = nested.name + "." + layer.name;
  for (auto* names : {&layers.image_copies, &layers.moments}) {
    for (std::string& name : *names) name = nested.name + "." + name;
  }
  for (FeatureLayer& layer : before.features) layers.features.push_back(std::move(layer));
  return nested;
}

}  // namespace norrsken
