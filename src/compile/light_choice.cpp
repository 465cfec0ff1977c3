#include "compile/light_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "color/srgb.h"

namespace norrsken {

namespace {

double luminance_of(const glm::dvec3& color) { return luminance(color.r, color.g, color.b); }

}  // namespace

LightPower surface_power(double area, const glm::dvec3& radiance, const LightBounds& bounds) {
  return {.own = std::numbers::pi * area * luminance_of(radiance), .bounds = bounds};
}
LightPower beam_power(double area, const glm::dvec3& irradiance) { return {.own = area * luminance_of(irradiance)}; }
LightPower point_power(const glm::dvec3& intensity, const LightBounds& bounds) {
  return {.own = 4 * std::numbers::pi * luminance_of(intensity), .bounds = bounds};
}
LightPower spot_power(const glm::dvec3& intensity, double beam, double cutoff, const LightBounds& bounds) {
  // The integral of the falloff over the cone's solid angle, in closed form; its limit if there is no edge.
  const double share = cutoff > beam ? 1 - (std::sin(cutoff) - std::sin(beam)) / (cutoff - beam) : 1 - std::cos(cutoff);
  return {.own = 2 * std::numbers::pi * share * luminance_of(intensity), .bounds = bounds};
}
LightPower projector_power(double area, const glm::dvec3& irradiance, const LightBounds& bounds) {
  return {.own = std::numbers::pi * area * luminance_of(irradiance), .bounds = bounds};
}
LightPower directional_power(const glm::dvec3& irradiance) { return {.per_cross_section = luminance_of(irradiance)}; }
LightPower environment_power(const glm::dvec3& radiance) {
  return {.per_cross_section = 4 * std::numbers::pi * luminance_of(radiance)};
}

std::vector<double> shares_of_choice(std::span<const LightPower> lights) {
  double own_total = 0, own_count = 0;
  for (const LightPower& light : lights) {
    if (!(light.weight > 0)) continue;
    own_total += light.own;
    own_count += light.own > 0 ? 1 : 0;
  }
  std::vector<double> shares;
  for (const LightPower& light : lights) {
    double share = light.per_cross_section > 0 ? 1 : 0;
    if (light.own > 0 && light.weight > 0) share += 0.5 * light.own / own_total + 0.5 / own_count;
    shares.push_back(light.weight * share);
  }
  return shares;
}

void fill_alias_table(std::span<LightRecord> lights, std::span<const double> shares) {
  double total = 0;
  for (const double share : shares) total += share;
  const auto count = static_cast<double>(lights.size());

  // Each light's probability in units of a column of the table, sorted into columns with room and columns too full.
  Array<double> level(lights.size());
  Array<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    level[i] = total > 0 ? shares[i] / total * count : 1;
    lights[i].prob = static_cast<float>(level[i] / count);
    lights[i].alias_prob = 1;
    lights[i].alias = i;
    (level[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t receiver = small.back(), donor = large.back();
    small.pop_back();
    lights[receiver].alias_prob = static_cast<float>(level[receiver]);
    lights[receiver].alias = donor;
    level[donor] -= 1 - level[receiver];
    if (level[donor] < 1) {
      large.pop_back();
      small.push_back(donor);
    }
  }
  // What is left over differs from 1 by rounding alone and keeps its column. A light that must never be chosen cannot
  // be among it: its level is exactly 0, and the others' sum then leaves a donor until it is served.
}

void choose_lights(SceneTables& tables, std::span<const LightPower> lights) {
  fill_alias_table(tables.lights, shares_of_choice(lights));
  const auto has_place = [](const LightPower& light) { return light.own > 0 && light.weight > 0; };
  const bool large = tables.surfaces.size() >= kLargeScene || !tables.instances.empty();
  const std::size_t from = large ? 2 : kLightTreeFrom;
  if (static_cast<std::size_t>(std::ranges::count_if(lights, has_place)) >= from) build_light_tree(tables, lights);
}

}  // namespace norrsken
