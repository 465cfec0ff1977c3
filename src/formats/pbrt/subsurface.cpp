#include "formats/pbrt/subsurface.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace norrsken::pbrt {
namespace {

struct Named {
  std::string_view name;
  glm::dvec3 albedo;
};
const Named kNamed[] = {
    {"Apple", {0.85, 0.84, 0.53}},  {"Chicken1", {0.31, 0.15, 0.10}},   {"Chicken2", {0.32, 0.25, 0.21}},
    {"Cream", {0.98, 0.90, 0.73}},  {"Ketchup", {0.16, 0.01, 0.00}},    {"Marble", {0.83, 0.79, 0.75}},
    {"Potato", {0.77, 0.62, 0.21}}, {"Skimmilk", {0.81, 0.81, 0.69}},   {"Skin1", {0.44, 0.22, 0.13}},
    {"Skin2", {0.63, 0.44, 0.34}},  {"Spectralon", {1.00, 1.00, 1.00}}, {"Wholemilk", {0.91, 0.88, 0.76}}};

}  // namespace

glm::dvec3 multiple_scattering_albedo(const glm::dvec3& absorbed, const glm::dvec3& scattered, double g) {
  glm::dvec3 albedo(0);
  for (int c = 0; c < 3; ++c) {
    const double extinct = absorbed[c] + scattered[c];
    if (!(extinct > 0)) continue;
    const double single = scattered[c] / extinct;
    const double s = glm::sqrt((1 - single) / glm::max(1 - single * g, 1e-9));
    albedo[c] = glm::clamp((1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s), 0.0, 1.0);
  }
  return albedo;
}

std::optional<glm::dvec3> named_subsurface_albedo(std::string_view name) {
  for (const Named& named : kNamed) {
    if (named.name == name) return named.albedo;
  }
  return std::nullopt;
}

std::vector<std::string> subsurface_names() {
  std::vector<std::string> names;
  for (const Named& named : kNamed) names.emplace_back(named.name);
  return names;
}

glm::dvec3 hair_absorption(const glm::dvec3& color, double azimuthal_roughness) {
  const double b = azimuthal_roughness;
  const double scale = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
  // Black absorbs all: more than that of this colour makes no difference.
  const glm::dvec3 ratio = glm::log(glm::max(color, glm::dvec3(1e-6))) / scale;
  return ratio * ratio;
}

}  // namespace norrsken::pbrt
