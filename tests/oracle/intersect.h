// Ray intersections as the report derives them, in double precision, one primitive after the other.
#pragma once

#include <optional>

#include "tests/oracle/scene.h"

namespace norrsken::oracle {

struct Ray {
  Vec origin;
  Vec direction;  ///< need not be unit: distances are in multiples of it
};

struct Hit {
  double t = 0;
  Vec normal;  ///< unit, on the front of the surface
  Material material;
  Rgb emission;
};

/// Distance to the triangle along the ray, if the line meets it; may be negative.
std::optional<double> intersect(const Triangle& triangle, const Ray& ray);
/// Distance to where the line enters the sphere.
std::optional<double> intersect(const Sphere& sphere, const Ray& ray);

/// The nearest surface in front of the ray's origin.
std::optional<Hit> closest_hit(const Scene& scene, const Ray& ray);
/// Whether nothing lies strictly between two points.
bool visible(const Scene& scene, const Vec& from, const Vec& to);

}  // namespace norrsken::oracle
