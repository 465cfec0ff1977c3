#include "bsdf/coat_host.h"

#include <fmt/format.h>

#include "bsdf/ior_host.h"

namespace norrsken {
namespace {

double mean(const ColorParameter& c) { return (c.value.r + c.value.g + c.value.b) / 3; }

}  // namespace

CoatMaterial read_coat(Parameters& p, Builder& builder) {
  CoatMaterial c;
  c.diffuse_reflectance = builder.color(p, "diffuse_reflectance", glm::dvec3(0.5), 0, 1);
  c.specular_reflectance = builder.color(p, "specular_reflectance", glm::dvec3(1), 0, 1);
  c.eta = read_relative_ior(p, "polypropylene");
  c.nonlinear = p.boolean("nonlinear", false);
  const glm::dvec3 base = c.diffuse_reflectance.value;
  c.description = fmt::format("eta {:.4g}, diffuse reflectance {:.3g} {:.3g} {:.3g}", c.eta, base.r, base.g, base.b);
  if (c.nonlinear) c.description += ", nonlinear";
  return c;
}

ParameterBlock coat_block(const CoatMaterial& coat, double from_inside) {
  const double specular = mean(coat.specular_reflectance), diffuse = mean(coat.diffuse_reflectance);
  const double specular_mean = specular + diffuse > 0 ? specular / (specular + diffuse) : 0.5;
  ParameterBlock block;
  block.add(coat.diffuse_reflectance).add(coat.specular_reflectance);
  return block.add(coat.eta).add(from_inside).add(specular_mean).add(coat.nonlinear ? 1.0 : 0.0);
}

}  // namespace norrsken
