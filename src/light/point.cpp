// point: an emitter that shines alike in all directions from one point.
#include <fmt/core.h>

#include "light/light_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kIntensity{.name = "intensity",
                                    .fallback = 1,
                                    .range = {0, kMaxEmission},
                                    .text = "radiant intensity",
                                    .unit = "W / sr",
                                    .of = ColorOf::light};
constexpr PointParameter kPosition{.name = "position", .unit = "scene units"};
constexpr TransformParameter kToWorld{
    .name = "to_world", .text = "the light is where it takes the origin", .in_place_of = "position"};

}  // namespace

void compile_emitter_point(Parameters& p, Lights& lights, std::uint32_t /*shape*/) {
  if (p.has(kPosition.name) && p.has(kToWorld.name)) {
    p.error(kToWorld.name, "emitter 'point' has both 'position' and 'to_world'", "one of them");
  }
  glm::dvec3 position = p.read(kPosition);
  const glm::dmat4 to_world = p.read(kToWorld);
  if (p.has(kToWorld.name)) position = to_world[3];
  const glm::dvec3 intensity = p.read(kIntensity).rgb();
  LightRecord light{};
  light.kind = LightKind::point;
  set_values(light.origin, position);
  set_values(light.emission, intensity);
  lights.add(light, point_power(intensity, {.lower = position, .upper = position}));
  lights.describe(p.node(), fmt::format("intensity {:.6g} {:.6g} {:.6g}", intensity.r, intensity.g, intensity.b));
}

}  // namespace norrsken
