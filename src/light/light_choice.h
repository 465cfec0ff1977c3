// How next-event estimation chooses among lights.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tables/scene_tables.h"

namespace norrsken {

/// How much a light sends into the scene, in the sense of luminance.
struct LightPower {
  double own = 0;                ///< of lights in the scene: pi A L of a surface, 4 pi I of a point
  double per_cross_section = 0;  ///< of lights around it: what crosses a unit of area, times the scene's pi R^2
};

/// pi A L, for a surface that emits radiance L to one side.
LightPower surface_power(double area, const glm::dvec3& radiance);
/// 4 pi I, for a point of radiant intensity I.
LightPower point_power(const glm::dvec3& intensity);
/// Of a cone in which the intensity I falls linearly with the angle between `beam` and `cutoff` (radians).
LightPower spot_power(const glm::dvec3& intensity, double beam, double cutoff);
/// pi A E, for a picture of (mean) irradiance pi E and of this area.
LightPower projector_power(double area, const glm::dvec3& irradiance);
/// E for each unit of cross-section.
LightPower directional_power(const glm::dvec3& irradiance);
/// 4 pi L for each unit of cross-section, for an environment of (mean) radiance L.
LightPower environment_power(const glm::dvec3& radiance);

/// How often each light should be chosen, in proportion. Each light around the scene has as large a share as all lights
/// in it together, because how much of its power arrives is not known; of those in it, half is dealt out by power and
/// half evenly, so that a weak light nearby is not left to chance. What has no power gets nothing.
/// Source: the even split between infinite lights and the others is that of pbrt-v4 (Pharr, Jakob, Humphreys, section
/// 12.6.3).
std::vector<double> shares_of_choice(std::span<const LightPower> lights);

/// Fills `prob`, `alias_prob` and `alias` of every record so that a light is chosen with probability proportional to
/// its share; uniformly if none has any.
///
/// Source: Vose 1991, A Linear Algorithm for Generating Random Numbers with a Given Distribution.
void choose_lights(std::span<LightRecord> lights, std::span<const double> shares);

}  // namespace norrsken
