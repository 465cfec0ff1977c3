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

/// What a plastic stores of its coat.
struct CoatSlots {
  ColorSlot diffuse_reflectance, specular_reflectance;
  float eta;
  float from_inside;  ///< the coat's reflectance for diffuse light from below
  float specular_mean;
  float nonlinear;  ///< 1 if it is
};

template <class Stored>
NORRSKEN_INLINE Coat load_coat(const ParameterReader& p, CoatSlots Stored::*coat) {
  Coat c;
  c.diffuse_reflectance = p.get(coat, &CoatSlots::diffuse_reflectance);
  c.specular_reflectance = p.get(coat, &CoatSlots::specular_reflectance);
  c.eta = p.get(coat, &CoatSlots::eta), c.specular_mean = p.get(coat, &CoatSlots::specular_mean);
  const Float from_inside = p.get(coat, &CoatSlots::from_inside), out = 1.0f / (c.eta * c.eta);
  const Mask nonlinear = p.get(coat, &CoatSlots::nonlinear) > 0.5f;
  const auto series = [&](Float reflectance) {
    const Float repeated = select(nonlinear, reflectance, 1.0f);
    return reflectance * out / fnma(repeated, from_inside, 1.0f);
  };
  c.inside = {series(c.diffuse_reflectance.r), series(c.diffuse_reflectance.g), series(c.diffuse_reflectance.b)};
  return c;
}

}  // namespace norrsken::NORRSKEN_ISA
