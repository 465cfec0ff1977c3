#include "scene/scene_color.h"

#include <glm/common.hpp>

#include "color/spectrum.h"

namespace norrsken {

glm::dvec3 SceneColor::rgb() const {
  if (const double* grey = std::get_if<double>(&said_)) return glm::dvec3(*grey);
  if (const glm::dvec3* rgb = std::get_if<glm::dvec3>(&said_)) return *rgb;
  const Spectrum& spectrum = std::get<Spectrum>(said_);
  const ColorVector rgb = of_ == ColorOf::light ? rgb_of_emission(spectrum) : rgb_of_reflectance(spectrum);
  return glm::clamp(glm::dvec3(rgb[0], rgb[1], rgb[2]), range_.min, range_.max);
}

double SceneColor::mean() const {
  const glm::dvec3 c = rgb();
  // The mean of three that are the same is not always the same.
  return c.x == c.y && c.y == c.z ? c.x : (c.x + c.y + c.z) / 3;
}

}  // namespace norrsken
