#include "tests/oracle/oracle.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace norrsken::oracle {

namespace {

constexpr double kPi = std::numbers::pi;

double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// A uniformly distributed point: Turk 1990, folding the parallelogram onto the triangle.
Vec random_point(const Triangle& triangle, Random& random) {
  double u = uniform(random), v = uniform(random);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return triangle.v0 + u * (triangle.v1 - triangle.v0) + v * (triangle.v2 - triangle.v0);
}

/// A direction on the hemisphere around `normal`, of density 1 / (2 pi) per solid angle: Archimedes' theorem makes
/// the height uniform; a direction below the horizon is taken to the other side.
Vec random_direction(const Vec& normal, Random& random) {
  const double z = 2 * uniform(random) - 1;
  const double azimuth = 2 * kPi * uniform(random);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  const Vec direction{r * std::cos(azimuth), r * std::sin(azimuth), z};
  return dot(direction, normal) < 0 ? -direction : direction;
}

/// One shadow ray to the point lights and one to a random point of the area lights: the irradiance at `point`.
Rgb direct_irradiance(const Scene& scene, const Vec& point, const Vec& normal, Random& random) {
  Rgb irradiance;
  for (const PointLight& light : scene.point_lights) {
    const Vec d = light.position - point;
    const double cosine = dot(normal, d) / length(d);
    if (cosine > 0 && visible(scene, point, light.position)) irradiance += light.intensity * (cosine / dot(d, d));
  }
  if (!scene.emitters.empty()) {
    const double count = static_cast<double>(scene.emitters.size());
    const auto chosen = static_cast<std::size_t>(uniform(random) * count);
    const Triangle& light = scene.triangles[scene.emitters[chosen]];
    const Vec d = random_point(light, random) - point;
    const double distance = length(d);
    const double cosine = dot(normal, d) / distance;
    const double cosine_at_light = -dot(light.normal, d) / distance;
    if (cosine > 0 && cosine_at_light > 0 && visible(scene, point, point + d)) {
      const double area = length(cross(light.v1 - light.v0, light.v2 - light.v0)) / 2;
      irradiance += light.emission * (cosine * cosine_at_light * area * count / (distance * distance));
    }
  }
  return irradiance;
}

/// `sees_lights`: whether the emission of what this ray hits counts. It does not behind a diffuse hit that has sent
/// shadow rays, which have already counted it.
Rgb trace(const Scene& scene, const Ray& ray, int bounces, bool sees_lights, const Settings& settings, Random& random) {
  const auto hit = closest_hit(scene, ray);
  if (!hit || dot(ray.direction, hit->normal) >= 0) return {};
  Rgb result;
  if (sees_lights) result += hit->emission;
  if (bounces == 0) return result;

  const Vec point = ray.origin + hit->t * ray.direction;
  const Vec& normal = hit->normal;
  if (hit->material.kind == Material::Kind::mirror) {
    const Vec reflected = ray.direction - 2 * dot(ray.direction, normal) * normal;
    return result + trace(scene, {point, reflected}, bounces - 1, true, settings, random);
  }

  const Rgb albedo = hit->material.albedo;
  for (int i = 0; i < settings.light_rays; ++i) {
    result += albedo * direct_irradiance(scene, point, normal, random) / (kPi * settings.light_rays);
  }
  if (settings.diffuse_bounces) {
    const Vec direction = random_direction(normal, random);
    const double cosine = dot(direction, normal);
    // albedo / pi, times the cosine, over the density 1 / (2 pi)
    result +=
        2 * cosine * albedo * trace(scene, {point, direction}, bounces - 1, settings.light_rays == 0, settings, random);
  }
  return result;
}

}  // namespace

Rgb radiance(const Scene& scene, const Ray& ray, const Settings& settings, Random& random) {
  return trace(scene, ray, settings.bounces, true, settings, random);
}

statistics::Picture render(const Scene& scene, const Camera& camera, const Settings& settings, const Sampling& sampling,
                           std::uint64_t seed) {
  Random random(seed);
  statistics::Picture picture(sampling.width, sampling.height);
  const int n = sampling.strata;
  for (int y = 0; y < sampling.height; ++y) {
    for (int x = 0; x < sampling.width; ++x) {
      Rgb sum;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const double fx = (x + (i + uniform(random)) / n) / sampling.width;
          const double fy = (y + (j + uniform(random)) / n) / sampling.height;
          const Vec on_film = camera.top_left + fx * camera.across + fy * camera.down;
          sum += radiance(scene, {camera.eye, on_film - camera.eye}, settings, random);
        }
      }
      const Rgb mean = sum / (n * n);
      picture.at(x, y) = {mean.x, mean.y, mean.z};
    }
  }
  return picture;
}

statistics::RegionEstimates estimate(const Scene& scene, const Camera& camera, const Settings& settings,
                                     const Sampling& sampling, std::vector<statistics::Region> regions) {
  statistics::RegionMeans means(std::move(regions));
  for (int i = 0; i < sampling.replicates; ++i) {
    means.add(render(scene, camera, settings, sampling, sampling.first_seed + static_cast<std::uint64_t>(i)));
  }
  return means.estimates();
}

}  // namespace norrsken::oracle
