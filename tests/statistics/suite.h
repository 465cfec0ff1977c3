// Every family of statistical comparisons in the test suite and its size, so that the level of one comparison can be
// chosen for the suite as a whole. A judge refuses to make more or fewer comparisons than are entered here.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace norrsken::statistics {

/// Probability that a suite without any error in it fails; the seeds being fixed, it would then always fail.
inline constexpr double kSuiteLevel = 0.01;

struct Family {
  std::string_view name;
  int comparisons;
};

/// R, G, B of the whole image, 4 quadrants and 4 x 4 blocks.
inline constexpr int kPerPicture = 3 * (1 + 4 + 16);

inline constexpr Family kSuite[] = {
    {"judge.synthetic", kPerPicture},
    {"oracle.point_light_over_plane", kPerPicture},
    {"oracle.rectangle_over_plane", kPerPicture},
    {"oracle.uniform_room", 4 * 3 * (1 + 4)},
    {"oracle.shadow_rays_against_chance_hits", 3 * (1 + 4)},
    {"plane.point", kPerPicture},
    {"plane.rectangle", kPerPicture},
    {"plane.triangle", kPerPicture},
    {"plane.sphere", kPerPicture},
    {"plane.all_path", kPerPicture},
    {"plane.all_direct", kPerPicture},
    {"plane.all_whitted", kPerPicture},
    {"plane.two_sided_from_below", kPerPicture},
    {"closed_room.uniform", 5 * kPerPicture},
    {"closed_room.uniform_sphere", 5 * kPerPicture},
    {"russian_roulette", 3 * 3 * (1 + 4)},
    {"room.area_0_bounces", kPerPicture},
    {"room.area_1_bounce", kPerPicture},
    {"room.area_2_bounces", kPerPicture},
    {"room.area_3_bounces", kPerPicture},
    {"room.area_4_bounces", kPerPicture},
    {"room.point_0_bounces", kPerPicture},
    {"room.point_1_bounce", kPerPicture},
    {"room.point_2_bounces", kPerPicture},
    {"room.point_3_bounces", kPerPicture},
    {"room.point_4_bounces", kPerPicture},
    {"room.area_direct", kPerPicture},
    {"room.area_whitted", kPerPicture},
    {"room.point_whitted", kPerPicture},
    {"room.area_4_shadow_rays", kPerPicture},
    {"agreement.shadow_rays", 2 * kPerPicture},
    {"agreement.samplers", kPerPicture},
    {"agreement.odd_samples", kPerPicture},
    {"agreement.accelerator.planes", kPerPicture},
    {"agreement.accelerator.embree", kPerPicture},
    {"agreement.isa.scalar", kPerPicture},
    {"agreement.isa.sse4.2", kPerPicture},
    {"agreement.isa.avx2", kPerPicture},
    {"agreement.isa.avx512", kPerPicture},
};

constexpr int suite_comparisons() {
  int sum = 0;
  for (const Family& family : kSuite) sum += family.comparisons;
  return sum;
}

constexpr int planned_comparisons(std::string_view name) {
  for (const Family& family : kSuite) {
    if (family.name == name) return family.comparisons;
  }
  throw std::invalid_argument("not entered in suite.h: " + std::string(name));
}

}  // namespace norrsken::statistics
