#include "bsdf/coat_host.h"

#include <fmt/core.h>

namespace norrsken {
namespace {

constexpr ColorParameter kDiffuseReflectance{
    .name = "diffuse_reflectance", .fallback = 0.5, .range = kShare, .text = "of the base below the coat"};
constexpr ColorParameter kSpecularReflectance{.name = "specular_reflectance",
                                              .fallback = 1,
                                              .range = kShare,
                                              .text = "factor on the light that the coat reflects"};
constexpr BooleanParameter kNonlinear{
    .name = "nonlinear", .text = "light that the coat sends back is coloured by the base once more each time"};

double mean(const glm::dvec3& c) { return (c.r + c.g + c.b) / 3; }

}  // namespace

CoatMaterial read_coat(Parameters& p, Materials& materials, const IorParameter& inside, const IorParameter& outside) {
  CoatMaterial c;
  c.diffuse_reflectance = materials.read(p, kDiffuseReflectance);
  c.specular_reflectance = materials.read(p, kSpecularReflectance);
  c.eta = read_relative_ior(p, inside, outside);
  c.nonlinear = p.read(kNonlinear);
  const glm::dvec3 base = c.diffuse_reflectance.rgb();
  c.description = fmt::format("eta {:.4g}, diffuse reflectance {:.3g} {:.3g} {:.3g}", c.eta, base.r, base.g, base.b);
  if (c.nonlinear) c.description += ", nonlinear";
  return c;
}

isa_host::CoatSlots coat_slots(const CoatMaterial& coat, double from_inside) {
  const double specular = mean(coat.specular_reflectance.rgb()), diffuse = mean(coat.diffuse_reflectance.rgb());
  const double specular_mean = specular + diffuse > 0 ? specular / (specular + diffuse) : 0.5;
  return {.diffuse_reflectance = coat.diffuse_reflectance,
          .specular_reflectance = coat.specular_reflectance,
          .eta = static_cast<float>(coat.eta),
          .from_inside = static_cast<float>(from_inside),
          .specular_mean = static_cast<float>(specular_mean),
          .nonlinear = coat.nonlinear ? 1.0f : 0.0f};
}

}  // namespace norrsken
