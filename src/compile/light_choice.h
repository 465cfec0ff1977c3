// How next-event estimation chooses among lights.
#pragma once

#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "tables/scene_tables.h"

namespace norrsken {

/// Where a light is and where it shines to. A point that shines alike in all directions, if nothing else is said.
struct LightBounds {
  glm::dvec3 lower{0}, upper{0};
  glm::dvec3 axis{0, 0, 1};                ///< unit; of a cone that holds all normals
  double normals = std::numbers::pi;       ///< half its opening
  double emission = std::numbers::pi / 2;  ///< how far off a normal there still is light; it grows weaker up to there
};

/// How much a light sends into the scene, in the sense of luminance.
struct LightPower {
  double own = 0;                ///< of lights in the scene: pi A L of a surface, 4 pi I of a point
  double per_cross_section = 0;  ///< of lights around it: what crosses a unit of area, times the scene's pi R^2
  LightBounds bounds = {};       ///< of lights in the scene
  double weight = 1;             ///< factor on how often it is chosen; 0: never
};

/// pi A L, for a surface that emits radiance L to one side.
LightPower surface_power(double area, const glm::dvec3& radiance, const LightBounds& bounds);
/// A E, for a surface that emits irradiance E along its normals. Only paths from the lights find it.
LightPower beam_power(double area, const glm::dvec3& irradiance);
/// 4 pi I, for a point of radiant intensity I.
LightPower point_power(const glm::dvec3& intensity, const LightBounds& bounds);
/// Of a cone in which the intensity I falls linearly with the angle between `beam` and `cutoff` (radians).
LightPower spot_power(const glm::dvec3& intensity, double beam, double cutoff, const LightBounds& bounds);
/// pi A E, for a picture of (mean) irradiance pi E and of this area.
LightPower projector_power(double area, const glm::dvec3& irradiance, const LightBounds& bounds);
/// E for each unit of cross-section.
LightPower directional_power(const glm::dvec3& irradiance);
/// 4 pi L for each unit of cross-section, for an environment of (mean) radiance L.
LightPower environment_power(const glm::dvec3& radiance);

/// How often each light should be chosen, in proportion. Each light around the scene has as large a share as all lights
/// in it together, because how much of its power arrives is not known; of those in it, half is dealt out by power and
/// half evenly, so that a weak light nearby is not left to chance. What has no power, or no weight, gets nothing.
/// Source: the even split between infinite lights and the others is that of pbrt-v4 (Pharr, Jakob, Humphreys, section
/// 12.6.3).
std::vector<double> shares_of_choice(std::span<const LightPower> lights);

/// Fills `prob`, `alias_prob` and `alias` of every record so that a light is chosen with probability proportional to
/// its share; uniformly if none has any.
///
/// Source: Vose 1991, A Linear Algorithm for Generating Random Numbers with a Given Distribution.
void fill_alias_table(std::span<LightRecord> lights, std::span<const double> shares);

/// Fills `light_nodes`, `light_leaves` and `lights_around`, so that lights are chosen by place (src/light/light_tree.h).
void build_light_tree(SceneTables& tables, std::span<const LightPower> lights);

/// Of so many lights on, choosing by place is worth what it costs: see docs/performance.md. In large scenes, of instances
/// or so many primitives, rays cost more than that, and two lights are enough.
inline constexpr std::size_t kLightTreeFrom = 8, kLargeScene = 1000;

/// What the scene's lights are chosen by: the alias table, and where points of surfaces choose among many, the tree.
void choose_lights(SceneTables& tables, std::span<const LightPower> lights);

}  // namespace norrsken
