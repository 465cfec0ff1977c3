// spot: a point that shines into a cone around a direction, perhaps through a picture.
//
// Parameters
//   intensity     color, radiant intensity in the beam in W / sr, at least 0 (default 1)
//   cutoff_angle  degrees off the axis, above 0 and below 180 (default 20): nothing beyond
//   beam_width    degrees off the axis, from 0 to cutoff_angle (default 3/4 of it): the full intensity up to there, then
//                 falling linearly with the angle
//   texture       texture, factor on the intensity: its square fits the cone's circle tightly; cutoff_angle is then
//                 below 90. Seen along the beam with +y up, u runs to the left and v up
//   to_world      transform (default identity); the light is at the local origin and points along +z
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "compile/field_of_view.h"
#include "compile/plugins.h"
#include "light/light_host.h"

namespace norrsken {

void compile_emitter_spot(Parameters& p, Builder& builder, std::uint32_t /*shape*/) {
  const glm::dvec3 intensity = p.color("intensity", glm::dvec3(1), 0, kMaxEmission, /*emission=*/true);
  const double cutoff_degrees = p.number("cutoff_angle", 20, 0, 180, Ends::open);
  const double beam_degrees = p.number_clamped("beam_width", 0.75 * cutoff_degrees, 0, cutoff_degrees);
  const glm::dmat4 to_world = p.transform("to_world");
  const std::optional<Texture> texture = slide_texture(p, builder, "texture");
  if (!texture) p.color("texture", glm::dvec3(1), 0, kMaxEmission);  // so that it counts as asked for
  if (!texture && p.has("texture")) {
    p.error("texture", "'texture' is of one value", "a texture that differs from place to place, such as bitmap");
  }
  if (texture && cutoff_degrees >= 90) {
    p.error("cutoff_angle", fmt::format("'cutoff_angle' is {:g} with a texture", cutoff_degrees), "an angle below 90");
  }

  const double cutoff = glm::radians(cutoff_degrees), beam = glm::radians(beam_degrees);
  ParameterBlock block;
  block.add(cutoff).add(std::cos(cutoff)).add(std::cos(beam)).add(beam < cutoff ? 1 / (cutoff - beam) : 0);
  block.add(1 / std::tan(cutoff)).add_word(texture ? texture->word : 0);
  LightRecord light{};
  light.kind = LightKind::spot;
  set_values(light.origin, to_world[3]);
  set_values(light.emission, intensity);
  set_axes(light, glm::inverse(glm::dmat3(to_world)));
  light.parameters = builder.add_parameters(block.values());
  LightBounds bounds{.lower = to_world[3], .upper = to_world[3]};
  const double length = glm::length(to_world[2]);
  // Where the cone keeps its shape, it is known what is outside.
  if (keeps_lengths(glm::dmat3(to_world) / length)) {
    bounds.axis = glm::dvec3(to_world[2]) / length;
    bounds.normals = beam, bounds.emission = cutoff - beam;
  }
  builder.add_light(light, spot_power(texture ? intensity * texture->mean : intensity, beam, cutoff, bounds));
  builder.describe(p.node(), fmt::format("intensity {:.6g} {:.6g} {:.6g}", intensity.r, intensity.g, intensity.b));
}

}  // namespace norrsken
