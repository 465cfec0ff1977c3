// The recursive oracle: the report's Monte Carlo ray tracer as a textbook would write it, scalar and in double
// precision. It is what the renderer is judged by, so it shares no code with it: not a vector, not a formula.
#pragma once

#include <cstdint>
#include <random>

#include "tests/oracle/intersect.h"
#include "tests/statistics/picture.h"

namespace norrsken::oracle {

using Random = std::mt19937_64;

struct Settings {
  int bounces = 3;     ///< surface hits that may scatter: paths end after so many
  int light_rays = 1;  ///< shadow rays per diffuse hit; 0: none, lights count wherever a path happens to hit them
  /// Whether diffuse hits send on a path. False is Whitted's method: mirrors and direct light alone.
  bool diffuse_bounces = true;
};

/// One sample of the radiance that arrives at the ray's origin.
Rgb radiance(const Scene& scene, const Ray& ray, const Settings& settings, Random& random);

/// An image of independent samples, `samples_per_pixel` in each pixel, uniform over its square. One image is one
/// replicate: statistics::RegionMeans turns several, of different seeds, into means with standard errors.
statistics::Picture render(const Scene& scene, const Camera& camera, int width, int height, int samples_per_pixel,
                           const Settings& settings, std::uint64_t seed);

}  // namespace norrsken::oracle
