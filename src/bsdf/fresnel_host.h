// Fresnel's equations where parameters are prepared.
#pragma once

namespace norrsken {

/// Share of perfectly diffuse light that an interface reflects; `eta` is the index of refraction beyond it over that on
/// the light's side, greater than 0. From inside a dense medium (eta < 1) that is the larger part.
/// These are the fits to the integral that Mitsuba takes, so that plastics look the same. From inside: Egan and Hilgeman,
/// "Determination of absorption and scattering coefficients for nonhomogeneous media 2", 1973; else d'Eon and Irving, "A
/// Quantized-Diffusion Model for Rendering Translucent Materials", 2011. Off by 0.001 at most between 1/2 and 2; for
/// diamond's 1/2.42 0.8693 instead of 0.8653, and worse beyond.
double fresnel_diffuse_reflectance(double eta);

}  // namespace norrsken
