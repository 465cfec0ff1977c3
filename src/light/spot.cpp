// spot: a point that shines into a cone around a direction, perhaps through a picture.
#include "light/spot.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "compile/field_of_view.h"
#include "light/light_host.h"

namespace norrsken {
namespace {

constexpr ColorParameter kIntensity{.name = "intensity",
                                    .fallback = 1,
                                    .range = {0, kMaxEmission},
                                    .text = "radiant intensity in the beam",
                                    .unit = "W / sr",
                                    .of = ColorOf::light};
constexpr NumberParameter kCutoffAngle{.name = "cutoff_angle",
                                       .fallback = 20,
                                       .range = {0, 180, Ends::open},
                                       .text = "off the axis: nothing beyond",
                                       .unit = "degrees"};
constexpr NumberParameter kBeamWidth{
    .name = "beam_width",
    .fallback = 15,
    .range = {0, 20},
    .text =
        "off the axis, up to cutoff_angle: the full intensity up to there, then falling linearly with the angle; if it "
        "is not given, 3/4 of cutoff_angle",
    .unit = "degrees",
    .beyond = Beyond::is_clamped};
constexpr TextureParameter kTexture{
    .name = "texture",
    .text =
        "factor on the intensity: its square fits the cone's circle tightly; cutoff_angle is then below 90. Seen along "
        "the beam with +y up, u runs to the left and v up"};
constexpr TransformParameter kToWorld{.name = "to_world",
                                      .text = "the light is at the local origin and points along +z"};

}  // namespace

void compile_emitter_spot(Parameters& p, Lights& lights, std::uint32_t /*shape*/) {
  const glm::dvec3 intensity = p.read(kIntensity).rgb();
  const double cutoff_degrees = p.read(kCutoffAngle);
  const double beam_degrees = p.read(kBeamWidth.or_else(0.75 * cutoff_degrees).within({0, cutoff_degrees}));
  const glm::dmat4 to_world = p.read(kToWorld);
  const std::optional<Texture> texture = slide_texture(p, lights, kTexture.name, p.read(kTexture));
  if (texture && cutoff_degrees >= 90) {
    p.error(kCutoffAngle.name, fmt::format("'cutoff_angle' is {:g} with a texture", cutoff_degrees),
            "an angle below 90");
  }

  const double cutoff = glm::radians(cutoff_degrees), beam = glm::radians(beam_degrees);
  LightRecord light{};
  light.kind = LightKind::spot;
  set_values(light.origin, to_world[3]);
  set_values(light.emission, intensity);
  set_axes(light, glm::inverse(glm::dmat3(to_world)));
  light.parameters = lights.store(
      isa_host::SpotLight::Stored{.cutoff = static_cast<float>(cutoff),
                                  .cos_cutoff = static_cast<float>(std::cos(cutoff)),
                                  .cos_beam = static_cast<float>(std::cos(beam)),
                                  .inverse_width = static_cast<float>(beam < cutoff ? 1 / (cutoff - beam) : 0),
                                  .inverse_tan_cutoff = static_cast<float>(1 / std::tan(cutoff)),
                                  .texture = texture ? texture->word : 0});
  LightBounds bounds{.lower = to_world[3], .upper = to_world[3]};
  const double length = glm::length(to_world[2]);
  // Where the cone keeps its shape, it is known what is outside.
  if (keeps_lengths(glm::dmat3(to_world) / length)) {
    bounds.axis = glm::dvec3(to_world[2]) / length;
    bounds.normals = beam, bounds.emission = cutoff - beam;
  }
  lights.add(light, spot_power(texture ? intensity * texture->mean : intensity, beam, cutoff, bounds));
  lights.describe(p.node(), fmt::format("intensity {:.6g} {:.6g} {:.6g}", intensity.r, intensity.g, intensity.b));
}

}  // namespace norrsken
