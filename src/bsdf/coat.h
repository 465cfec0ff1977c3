// Diffuse light from below a dielectric coat: what smooth and rough plastic share. Light that gets in is scattered
// diffusely; what meets the coat from inside is partly sent back and scattered again, as often as it takes.
// Source: the geometric series of these reflections; the factor 1 / eta^2 is that of radiance that leaves: Veach, "Robust
// Monte Carlo Methods for Light Transport Simulation", 1997, section 5.2.
#pragma once

#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {

struct Coat {
  Color specular_reflectance, diffuse_reflectance;
  Color inside;         ///< share of the light that gets in which arrives below the coat's other crossing
  Float eta;            ///< index of refraction below the coat's surface over that above
  Float specular_mean;  ///< mean specular reflectance over the sum of both means: steers samples

  /// Of choosing the specular part where the coat reflects `reflectance`.
  NORRSKEN_INLINE Float specular_prob(Float reflectance) const {
    const Float specular = reflectance * specular_mean;
    const Float diffuse = (1.0f - reflectance) * (1.0f - specular_mean);
    return specular / max(specular + diffuse, 1e-20f);
  }
};

/// The first 12 floats of a plastic: diffuse and specular reflectance (colours), eta, the coat's diffuse reflectance from
/// inside, specular_mean, 1 if `nonlinear`.
inline constexpr std::uint32_t kCoatFloats = 12;

NORRSKEN_INLINE Coat load_coat(const ParameterReader& p) {
  Coat c;
  c.diffuse_reflectance = p.color(0), c.specular_reflectance = p.color(4);
  c.eta = p.number(8), c.specular_mean = p.number(10);
  const Float from_inside = p.number(9), out = 1.0f / (c.eta * c.eta);
  const Mask nonlinear = p.number(11) > 0.5f;
  const auto series = [&](Float reflectance) {
    const Float repeated = select(nonlinear, reflectance, 1.0f);
    return reflectance * out / fnma(repeated, from_inside, 1.0f);
  };
  c.inside = {series(c.diffuse_reflectance.r), series(c.diffuse_reflectance.g), series(c.diffuse_reflectance.b)};
  return c;
}

}  // namespace norrsken::NORRSKEN_ISA
