// Scenes whose light can be written down: what the oracle and the renderer are measured against.
#pragma once

#include <span>

#include "tests/oracle/vector.h"

namespace norrsken::closed_form {

using oracle::Vec;

/// Irradiance of a point light of radiant intensity `intensity` (W/sr) at a point with unit normal: the inverse
/// square law with Lambert's cosine, I cos / d^2; 0 from behind. (Lambert 1760, Photometria.)
double point_light_irradiance(double intensity, const Vec& light, const Vec& point, const Vec& normal);

/// Irradiance of a planar polygon of uniform radiance L at a point with unit normal, the polygon being wholly above
/// the point's horizon and its front facing the point. The integral of cos over the polygon's solid angle becomes, by
/// Stokes' theorem, one along its edges: E = L/2 |sum_i theta_i n . g_i|, theta_i the angle that edge i subtends and
/// g_i the unit normal of the plane through it and the point. (Lambert 1760; Arvo 1994, "The irradiance Jacobian for
/// partially occluded polyhedral sources", equation 2.)
double polygon_irradiance(double radiance, std::span<const Vec> polygon, const Vec& point, const Vec& normal);

/// Irradiance of a sphere of uniform radiance L, wholly above the horizon of a point with unit normal. The cone of
/// tangents cuts the unit sphere around the point in a circle of radius sin(a) = radius / distance, whose projection
/// onto the plane has the area pi sin^2(a) cos: E = L pi sin^2(a) cos. (Nusselt 1928.)
double sphere_irradiance(double radiance, const Vec& centre, double radius, const Vec& point, const Vec& normal);

/// Radiance that leaves a Lambertian surface of reflectance `albedo` under an irradiance: albedo E / pi.
double reflected_radiance(double albedo, double irradiance);

/// Radiance everywhere in a closed room all of whose surfaces emit e and reflect r, by paths that scatter at most
/// `bounces` times: each bounce sees the same room, so e (1 + r + ... + r^bounces).
double uniform_room_radiance(double emission, double reflectance, int bounces);

}  // namespace norrsken::closed_form
