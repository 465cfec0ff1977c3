// Loads, renders and reads pixels through the installed headers and library alone.
#include <norrsken/render.h>

#include <cmath>
#include <cstdio>

int main() {
  norrsken::Diagnostics diagnostics;
  if (norrsken::Scene::load("no_such_scene.xml", {}, diagnostics) || !diagnostics.has_errors()) {
    std::puts("a missing scene was not complained about");
    return 1;
  }

  diagnostics = {};
  norrsken::LoadOptions options;
  options.width = options.height = 32;
  options.parameters = {{"spp", "4"}, {"shadow_rays", "1"}};
  const auto scene = norrsken::Scene::load("hexagon_room", options, diagnostics);
  const auto render = scene ? norrsken::Render::create(*scene, {}, diagnostics) : nullptr;
  if (!render) {
    for (const auto& diagnostic : diagnostics.all()) std::puts(norrsken::to_text(diagnostic).c_str());
    return 1;
  }
  const norrsken::RenderStatistics statistics = render->run();
  const norrsken::Image image = render->image();
  const norrsken::Channel* red = image.find("R");
  double sum = 0;
  if (red != nullptr) {
    for (const float value : red->values) sum += value;
  }
  std::printf("%llu samples, mean red %g\n", static_cast<unsigned long long>(statistics.samples), sum / (32 * 32));
  return statistics.samples == 32 * 32 * 4 && std::isfinite(sum) && sum > 0 ? 0 : 1;
}
