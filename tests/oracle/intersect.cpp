#include "tests/oracle/intersect.h"

#include <limits>

namespace norrsken::oracle {

namespace {
/// Hits nearer than this, in scene units, are the surface that the ray starts from. The rooms are some ten units
/// wide, so double precision puts hit points within 1e-14 of their surface.
constexpr double kEpsilon = 1e-9;
}  // namespace

// Names are the report's letters.
// NOLINTBEGIN(readability-identifier-naming)

// Möller and Trumbore 1997, in the report's letters, equations 1 to 9.
std::optional<double> intersect(const Triangle& triangle, const Ray& ray) {
  const Vec T = ray.origin - triangle.v0;     // (2)
  const Vec E1 = triangle.v1 - triangle.v0;   // (3)
  const Vec E2 = triangle.v2 - triangle.v0;   // (4)
  const Vec& D = ray.direction;               // (5)
  const Vec P = cross(D, E2);                 // (6)
  const double determinant = dot(P, E1);      // (9)
  if (determinant == 0) return std::nullopt;  // parallel to the plane
  const double u = dot(P, T) / determinant;
  if (!(u >= 0 && u <= 1)) return std::nullopt;
  const Vec Q = cross(T, E1);  // (7)
  const double v = dot(Q, D) / determinant;
  if (!(v >= 0 && u + v <= 1)) return std::nullopt;
  return dot(Q, E2) / determinant;
}

// The report's equations 10 and 11: t_ca is the distance to the point nearest to the centre, d how near it gets.
std::optional<double> intersect(const Sphere& sphere, const Ray& ray) {
  const double scale = length(ray.direction);
  const Vec D = ray.direction / scale;
  const Vec L = sphere.centre - ray.origin;
  const double t_ca = dot(L, D);
  const double d_squared = dot(L, L) - t_ca * t_ca;  // (11), Pythagoras
  const double r_squared = sphere.radius * sphere.radius;
  if (d_squared > r_squared) return std::nullopt;
  const double t_0 = t_ca - std::sqrt(r_squared - d_squared);
  return t_0 / scale;
}

// NOLINTEND(readability-identifier-naming)

std::optional<Hit> closest_hit(const Scene& scene, const Ray& ray) {
  const double nearest = kEpsilon / length(ray.direction);
  double t = std::numeric_limits<double>::infinity();
  const Triangle* triangle_hit = nullptr;
  const Sphere* sphere_hit = nullptr;
  for (const Triangle& triangle : scene.triangles) {
    const auto candidate = intersect(triangle, ray);
    if (candidate && *candidate > nearest && *candidate < t) t = *candidate, triangle_hit = &triangle;
  }
  for (const Sphere& sphere : scene.spheres) {
    const auto candidate = intersect(sphere, ray);
    if (candidate && *candidate > nearest && *candidate < t) t = *candidate, sphere_hit = &sphere;
  }
  if (sphere_hit) {
    const Vec point = ray.origin + t * ray.direction;  // (10)
    return Hit{t, normalize(point - sphere_hit->centre), sphere_hit->material, {}};
  }
  if (triangle_hit) return Hit{t, triangle_hit->normal, triangle_hit->material, triangle_hit->emission};
  return std::nullopt;
}

bool visible(const Scene& scene, const Vec& from, const Vec& to) {
  const Ray ray{from, to - from};
  const double epsilon = kEpsilon / length(ray.direction);
  const auto blocks = [&](const auto& surface) {
    const auto t = intersect(surface, ray);
    return t && *t > epsilon && *t < 1 - epsilon;
  };
  for (const Triangle& triangle : scene.triangles) {
    if (blocks(triangle)) return false;
  }
  for (const Sphere& sphere : scene.spheres) {
    if (blocks(sphere)) return false;
  }
  return true;
}

}  // namespace norrsken::oracle
