// Fresnel's equations where parameters are prepared.
#pragma once

namespace norrsken {

/// Share of perfectly diffuse light that an interface reflects; `eta` is the index of refraction beyond it over that on
/// the light's side, greater than 0. From inside a dense medium (eta < 1) that is the larger part.
double fresnel_diffuse_reflectance(double eta);

}  // namespace norrsken
