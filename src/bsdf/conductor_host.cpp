#include "bsdf/conductor_host.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "base/text.h"

namespace norrsken {
namespace {

constexpr double kMaxIndex = 1e4;

struct Metal {
  const char* name;
  double eta[3], k[3];
};

constexpr Metal kMetals[] = {
#include "bsdf/metals.def"
};

const Metal* find_metal(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kMetals), std::end(kMetals), [&](const Metal& m) { return m.name == name; });
  return found == std::end(kMetals) ? nullptr : found;
}

// Without a material Fresnel's factor is 1 in all directions.
constexpr TextParameter kMaterial{
    .name = "material",
    .fallback = "none",
    .text = "a conductor by name, from the table of measured ones; \"none\" reflects everything"};
constexpr ColorParameter kEta{.name = "eta",
                              .fallback = 0,
                              .range = {0, kMaxIndex},
                              .text =
                                  "real part of the index of refraction, over that of the surroundings; instead of a "
                                  "material"};
constexpr ColorParameter kK{.name = "k",
                            .fallback = 1,
                            .range = {0, kMaxIndex},
                            .text =
                                "imaginary part of the index of refraction, over that of the surroundings; instead "
                                "of a material"};
constexpr ColorParameter kSpecularReflectance{
    .name = "specular_reflectance", .fallback = 1, .range = kShare, .text = "factor on the reflected light"};

std::string text_of(const ColorOrTexture& color) {
  if (color.texture != 0) return "textured";
  const glm::dvec3 rgb = color.rgb();
  return fmt::format("{:.3g} {:.3g} {:.3g}", rgb.r, rgb.g, rgb.b);
}

}  // namespace

ConductorMaterial read_conductor(Parameters& p, Materials& materials) {
  const std::string material = p.read(kMaterial);
  const Metal* metal = find_metal(material);
  if (metal == nullptr && material != kMaterial.fallback) {
    std::vector<std::string> names{std::string(kMaterial.fallback)};
    for (const Metal& m : kMetals) names.emplace_back(m.name);
    p.error(kMaterial.name, fmt::format("'material' is {}{}", quoted(material), did_you_mean(material, names)),
            join(names));
  }
  for (const std::string_view name : {kEta.name, kK.name}) {
    if (metal == nullptr || !p.has(name)) continue;
    p.error(name, fmt::format("'{}' is given next to material {}", name, quoted(material)), "a material, or eta and k");
  }
  ConductorMaterial c;
  c.eta = materials.read(p, kEta);
  c.k = materials.read(p, kK);
  if (metal != nullptr) {
    c.eta = {SceneColor(glm::dvec3(metal->eta[0], metal->eta[1], metal->eta[2]))};
    c.k = {SceneColor(glm::dvec3(metal->k[0], metal->k[1], metal->k[2]))};
  }
  c.specular_reflectance = materials.read(p, kSpecularReflectance);
  c.description =
      metal != nullptr ? std::string(metal->name) : fmt::format("eta {}, k {}", text_of(c.eta), text_of(c.k));
  c.description += ", specular reflectance " + text_of(c.specular_reflectance);
  return c;
}

}  // namespace norrsken
