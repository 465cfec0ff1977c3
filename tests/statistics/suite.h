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

/// The same with two halves: oracle::room_regions.
inline constexpr int kPerRoom = kPerPicture + 3 * 2;

inline constexpr Family kSuite[] = {
    {"judge.synthetic", kPerPicture},
    {"oracle.point_light_over_plane", kPerPicture},
    {"oracle.rectangle_over_plane", kPerPicture},
    {"oracle.uniform_room", 4 * 3 * (1 + 4)},
    {"oracle.shadow_rays_against_chance_hits", 3 * (1 + 4)},
    {"oracle.room_reference", 8 * 3 * (1 + 2 + 4)},
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
    {"box.lamp", 3 * 3 * (1 + 4)},
    {"box.bulb", 4 * 3 * (1 + 4)},
    {"russian_roulette", 2 * 3 * (1 + 4)},
    {"unbounded_paths", 3 * (1 + 4)},
    {"light_paths.room", 3 * (1 + 4)},
    {"light_paths.direct", 3 * (1 + 4)},
    {"light_paths.roulette", 3 * (1 + 4)},
    {"light_paths.hidden_emitters", 3 * (1 + 4)},
    {"light_paths.outdoors", 3 * (1 + 4)},
    {"light_paths.glass", 3 * (1 + 4)},
    {"light_paths.lights", 3 * (1 + 4)},
    {"light_paths.near_far", 3 * (1 + 4)},
    {"light_paths.thinlens", 3 * (1 + 4)},
    {"light_paths.orthographic", 3 * (1 + 4)},
    {"light_paths.crop", 3 * (1 + 4)},
    {"light_paths.border", 3 * (1 + 4)},
    {"light_paths.plane", 3 * (1 + 4)},
    {"light_paths.uniform", 4 * 3 * (1 + 4)},
    {"direct.splits", 6 * 3 * (1 + 4)},
    {"room.area_0_bounces", kPerRoom},
    {"room.area_1_bounce", kPerRoom},
    {"room.area_2_bounces", kPerRoom},
    {"room.area_3_bounces", kPerRoom},
    {"room.area_4_bounces", kPerRoom},
    {"room.point_1_bounce", kPerRoom},
    {"room.point_3_bounces", kPerRoom},
    {"room.area_direct", kPerRoom},
    {"room.area_whitted", kPerRoom},
    {"room.point_whitted", kPerRoom},
    {"room.area_4_shadow_rays", kPerRoom},
    {"adaptive.room", kPerPicture},
    {"agreement.shadow_rays", 2 * kPerRoom},
    {"agreement.samplers", kPerRoom},
    {"agreement.odd_samples", kPerRoom},
    {"agreement.accelerator.planes", kPerRoom},
    {"agreement.accelerator.embree", kPerRoom},
    {"agreement.isa.sse4.2", kPerRoom},
    {"agreement.isa.avx2", kPerRoom},
    {"agreement.isa.avx512", kPerRoom},
    {"agreement.isa.neon", kPerRoom},
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
