// projector: throws a picture into the scene, as a perspective camera run backwards.
//
// Parameters
//   irradiance    color or texture, at least 0 (default 1): what a white wall at distance 1 shows, which is its
//                 irradiance over pi in W / m^2. A texture's resolution makes the picture's shape; a color is square
//   scale         number, at least 0 (default 1): factor on the irradiance
//   fov           number, degrees, above 0 and below 180
//   focal_length  string such as "50mm" (the default), in place of `fov`: as for the sensor 'perspective'
//   fov_axis      x (default), y, diagonal, smaller or larger: the side of the picture that `fov` spans
//   to_world      transform without scale; local +z is the direction of the light, +y up and +x left
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "compile/field_of_view.h"
#include "compile/plugins.h"
#include "light/light_host.h"

namespace norrsken {

void compile_emitter_projector(Parameters& p, Builder& builder, std::uint32_t /*shape*/) {
  const std::optional<Texture> texture = slide_texture(p, builder, "irradiance");
  glm::dvec3 irradiance(1);
  if (!texture) irradiance = p.color("irradiance", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  const double scale = p.number("scale", 1, 0, kMaxEmission);
  const double aspect = texture ? static_cast<double>(texture->width) / texture->height : 1;
  const double half_width = half_width_of_view(p, aspect), half_height = half_width / aspect;
  const glm::dmat4 to_world = p.transform("to_world");
  const glm::dmat3 linear(to_world);
  if (!keeps_lengths(linear)) {
    p.error("to_world", "'to_world' of emitter 'projector' scales", "translations, rotations and lookat");
  }

  LightRecord light{};
  light.kind = LightKind::projector;
  set_values(light.origin, to_world[3]);
  set_values(light.emission, std::numbers::pi * scale * irradiance);
  set_axes(light, glm::inverse(linear));
  ParameterBlock block;
  block.add(half_width).add(half_height).add_word(texture ? texture->word : 0);
  light.parameters = builder.add_parameters(block.values());
  const glm::dvec3 mean = scale * (texture ? texture->mean : irradiance);
  // Nothing beyond the corners.
  const LightBounds bounds{.lower = to_world[3],
                           .upper = to_world[3],
                           .axis = glm::normalize(linear[2]),
                           .normals = std::atan(std::hypot(half_width, half_height)),
                           .emission = 0};
  builder.add_light(light, projector_power(4 * half_width * half_height, mean, bounds));
  builder.describe(p.node(), fmt::format("irradiance {:.6g} {:.6g} {:.6g}", mean.r, mean.g, mean.b));
}

}  // namespace norrsken
