#include "integrator/integrator_host.h"

#include <fmt/core.h>

#include <limits>
#include <utility>

#include "base/text.h"

namespace norrsken {
namespace {

constexpr int kMax = std::numeric_limits<int>::max();
constexpr IntegerParameter kMaxDepth{.name = "max_depth",
                                     .fallback = -1,
                                     .min = -1,
                                     .max = kMax,
                                     .text = "1 shows emitters only, 2 adds direct light, ...; -1 has no limit"};
constexpr IntegerParameter kBounces{.name = "bounces",
                                    .fallback = -1,
                                    .min = 0,
                                    .max = kMax - 1,
                                    .text = "surfaces that a path is scattered by at most, which is max_depth - 1",
                                    .in_place_of = "max_depth"};
constexpr IntegerParameter kRouletteDepth{
    .name = "rr_depth", .fallback = 5, .min = 1, .max = kMax, .text = "depth from which Russian roulette ends paths"};
constexpr IntegerParameter kEmitterSamples{
    .name = "emitter_samples", .fallback = 1, .min = 1, .max = kMaxShadingSamples, .text = "shadow rays per hit"};

}  // namespace

IntegratorSettings read_path_lengths(Parameters& p) {
  IntegratorSettings settings;
  settings.max_depth = static_cast<int>(p.read(kMaxDepth));
  const int bounces = static_cast<int>(p.read(kBounces));
  if (p.has(kBounces.name)) {
    if (p.has(kMaxDepth.name)) p.error(kBounces.name, "both 'bounces' and 'max_depth' are given", "one of them");
    settings.max_depth = bounces + 1;
  }
  settings.rr_depth = static_cast<int>(p.read(kRouletteDepth));
  return settings;
}

IntegratorSettings read_integrator(Parameters& p) {
  IntegratorSettings settings = read_path_lengths(p);
  settings.emitter_samples = static_cast<int>(p.read(kEmitterSamples));
  settings.hide_emitters = p.read(kHideEmitters);
  return settings;
}

IntegratorSettings read_volume_integrator(Parameters& p) {
  IntegratorSettings settings = read_integrator(p);
  settings.media = true;
  return settings;
}

NestedIntegrator read_nested_integrator(Parameters& p, Integrators& integrators) {
  NestedIntegrator nested;
  const Node::Child* child = p.child("integrator");
  if (!child) return nested;
  nested.plugin = child->node->plugin;
  nested.has_name = !child->name.empty();
  nested.name = nested.has_name ? child->name : "_arg_0";
  SceneLayers before = std::exchange(integrators.layers(), {});
  nested.settings = integrators.inside(*child->node);
  SceneLayers& layers = integrators.layers();
  for (FeatureLayer& layer : layers.features) layer.name = nested.name + "." + layer.name;
  for (auto* names : {&layers.image_copies, &layers.moments}) {
    for (std::string& name : *names) name = nested.name + "." + name;
  }
  for (FeatureLayer& layer : before.features) layers.features.push_back(std::move(layer));
  return nested;
}

}  // namespace norrsken
