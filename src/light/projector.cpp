// projector: throws a picture into the scene, as a perspective camera run backwards.
#include "light/projector.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "compile/field_of_view.h"
#include "light/light_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kIrradiance{.name = "irradiance",
                                     .fallback = 1,
                                     .range = {0, kMaxEmission},
                                     .text =
                                         "what a white wall at distance 1 shows, which is its irradiance over pi. A "
                                         "texture's resolution makes the picture's shape; a color is square",
                                     .unit = "W / m^2",
                                     .of = ColorOf::light};
constexpr NumberParameter kScale{
    .name = "scale", .fallback = 1, .range = {0, kMaxEmission}, .text = "factor on the irradiance"};
constexpr TransformParameter kToWorld{
    .name = "to_world", .text = "without scale; local +z is the direction of the light, +y up and +x left"};

}  // namespace

void compile_emitter_projector(Parameters& p, Lights& lights, std::uint32_t /*shape*/) {
  const std::optional<Texture> texture = slide_texture(p, lights, kIrradiance.name, p.texture(kIrradiance.name));
  glm::dvec3 irradiance(1);
  if (!texture) irradiance = p.read(kIrradiance).rgb();
  const double scale = p.read(kScale);
  const double aspect = texture ? static_cast<double>(texture->width) / texture->height : 1;
  const double half_width = half_width_of_view(p, aspect), half_height = half_width / aspect;
  const glm::dmat4 to_world = p.read(kToWorld);
  const glm::dmat3 linear(to_world);
  if (!keeps_lengths(linear)) {
    p.error(kToWorld.name, "'to_world' of emitter 'projector' scales", "translations, rotations and lookat");
  }

  LightRecord light{};
  light.kind = LightKind::projector;
  set_values(light.origin, to_world[3]);
  set_values(light.emission, std::numbers::pi * scale * irradiance);
  set_axes(light, glm::inverse(linear));
  light.parameters = lights.store(isa_host::ProjectorLight::Stored{.half_width = static_cast<float>(half_width),
                                                                   .half_height = static_cast<float>(half_height),
                                                                   .texture = texture ? texture->word : 0});
  const glm::dvec3 mean = scale * (texture ? texture->mean : irradiance);
  // Nothing beyond the corners.
  const LightBounds bounds{.lower = to_world[3],
                           .upper = to_world[3],
                           .axis = glm::normalize(linear[2]),
                           .normals = std::atan(std::hypot(half_width, half_height)),
                           .emission = 0};
  lights.add(light, projector_power(4 * half_width * half_height, mean, bounds));
  lights.describe(p.node(), fmt::format("irradiance {:.6g} {:.6g} {:.6g}", mean.r, mean.g, mean.b));
}

}  // namespace norrsken
