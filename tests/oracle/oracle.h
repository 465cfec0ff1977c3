// The recursive oracle: the report's Monte Carlo ray tracer as a textbook would write it, scalar and in double
// precision. It is what the renderer is judged by, so it shares no code with it: not a vector, not a formula.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tests/oracle/intersect.h"
#include "tests/statistics/estimate.h"
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

/// How many samples: `replicates` images of width x height pixels, each with seeds of its own from `first_seed` on,
/// with `strata` x `strata` samples in a pixel, one at random in each cell of its square.
struct Sampling {
  int width = 0, height = 0;
  int strata = 1;
  int replicates = 1;
  std::uint64_t first_seed = 1;
};

/// The replicate of that seed.
statistics::Picture render(const Scene& scene, const Camera& camera, const Settings& settings, const Sampling& sampling,
                           std::uint64_t seed);

/// Mean radiance of each region with its standard error.
statistics::RegionEstimates estimate(const Scene& scene, const Camera& camera, const Settings& settings,
                                     const Sampling& sampling, std::vector<statistics::Region> regions);

}  // namespace norrsken::oracle
