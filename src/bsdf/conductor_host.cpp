#include "bsdf/conductor_host.h"

#include <fmt/format.h>

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

std::string text_of(const ColorParameter& color) {
  return color.texture == 0 ? fmt::format("{:.3g} {:.3g} {:.3g}", color.value.r, color.value.g, color.value.b)
                            : std::string("textured");
}

}  // namespace

ConductorMaterial read_conductor(Parameters& p, Builder& builder) {
  const std::string material = p.text("material", "none");
  const Metal* metal = find_metal(material);
  if (metal == nullptr && material != "none") {
    std::vector<std::string> names{"none"};
    for (const Metal& m : kMetals) names.emplace_back(m.name);
    p.error("material", fmt::format("'material' is {}{}", quoted(material), did_you_mean(material, names)),
            join(names));
  }
  for (const char* name : {"eta", "k"}) {
    if (metal == nullptr || !p.has(name)) continue;
    p.error(name, fmt::format("'{}' is given next to material {}", name, quoted(material)), "a material, or eta and k");
  }
  // Without a material: Fresnel's factor is 1 in all directions.
  ConductorMaterial c;
  c.eta = builder.color(p, "eta", glm::dvec3(0), 0, kMaxIndex);
  c.k = builder.color(p, "k", glm::dvec3(1), 0, kMaxIndex);
  if (metal != nullptr) {
    c.eta = {glm::dvec3(metal->eta[0], metal->eta[1], metal->eta[2])};
    c.k = {glm::dvec3(metal->k[0], metal->k[1], metal->k[2])};
  }
  c.specular_reflectance = builder.color(p, "specular_reflectance", glm::dvec3(1), 0, 1);
  c.description =
      metal != nullptr ? std::string(metal->name) : fmt::format("eta {}, k {}", text_of(c.eta), text_of(c.k));
  c.description += ", specular reflectance " + text_of(c.specular_reflectance);
  return c;
}

}  // namespace norrsken
