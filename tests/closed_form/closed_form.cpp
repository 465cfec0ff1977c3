#include "tests/closed_form/closed_form.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace norrsken::closed_form {

double point_light_irradiance(double intensity, const Vec& light, const Vec& point, const Vec& normal) {
  const Vec d = light - point;
  const double cosine = dot(d, normal) / length(d);
  return intensity * std::max(0.0, cosine) / dot(d, d);
}

double polygon_irradiance(double radiance, std::span<const Vec> polygon, const Vec& point, const Vec& normal) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec a = polygon[i] - point;
    const Vec b = polygon[(i + 1) % polygon.size()] - point;
    const Vec across = cross(a, b);
    const double theta = std::atan2(length(across), dot(a, b));
    sum += theta * dot(normal, normalize(across));
  }
  return radiance / 2 * std::abs(sum);
}

double sphere_irradiance(double radiance, const Vec& centre, double radius, const Vec& point, const Vec& normal) {
  const Vec d = centre - point;
  return radiance * std::numbers::pi * radius * radius / dot(d, d) * dot(d, normal) / length(d);
}

double reflected_radiance(double albedo, double irradiance) { return albedo * irradiance / std::numbers::pi; }

double uniform_room_radiance(double emission, double reflectance, int bounces) {
  double sum = 0, power = 1;
  for (int i = 0; i <= bounces; ++i, power *= reflectance) sum += power;
  return emission * sum;
}

}  // namespace norrsken::closed_form
