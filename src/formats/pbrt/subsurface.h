// The colours of what light goes into and comes out of again, for surfaces that have to stand in for it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace norrsken::pbrt {

/// The share of light that a deep medium sends back (van de Hulst, "Multiple Light Scattering", 1980, in the fit of
/// Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", 2017).
glm::dvec3 multiple_scattering_albedo(const glm::dvec3& absorbed, const glm::dvec3& scattered, double g);

/// Diffuse reflectances measured by Jensen et al., "A Practical Model for Subsurface Light Transport", 2001, figure 5.
std::optional<glm::dvec3> named_subsurface_albedo(std::string_view name);
std::vector<std::string> subsurface_names();

/// What hair absorbs whose multiple scattering has that colour: Chiang et al., "A Practical and Controllable Hair and Fur
/// Model for Production Path Tracing", 2016, equation 9.
glm::dvec3 hair_absorption(const glm::dvec3& color, double azimuthal_roughness);
/// What a unit of either pigment absorbs (d'Eon et al., "An Energy-Conserving Hair Reflectance Model", 2011).
inline const glm::dvec3 kEumelanin(0.419, 0.697, 1.37), kPheomelanin(0.187, 0.4, 1.05);

}  // namespace norrsken::pbrt
