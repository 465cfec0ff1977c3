// The hexagon room as the renderer shows it, against the recursive oracle's.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/room.h"
#include "tests/oracle/oracle.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

using statistics::Judge;
using statistics::RegionMeans;

struct Case {
  std::string name;
  RoomVariant variant;
  int oracle_samples;  ///< per pixel and replicate; what it takes to see a bias of 0.5 %
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

RegionMeans oracle_room(const RoomVariant& variant, int samples_per_pixel) {
  const auto light = variant.light == "point" ? oracle::RoomLight::point : oracle::RoomLight::area;
  oracle::Settings settings{.bounces = variant.bounces};
  if (variant.integrator == "direct") settings.bounces = std::min(settings.bounces, 1);
  if (variant.integrator == "whitted") settings.diffuse_bounces = false;
  const oracle::Scene scene = oracle::hexagon_room(light);
  RegionMeans means(room_regions());
  for (std::uint64_t seed = 1; seed <= kRoomSeeds; ++seed) {
    means.add(
        oracle::render(scene, oracle::hexagon_room_camera(), kRoomSize, kRoomSize, samples_per_pixel, settings, seed));
  }
  return means;
}

class OracleRoom : public ::testing::TestWithParam<Case> {};

TEST_P(OracleRoom, ShowsTheSameRadiance) {
  const Case& c = GetParam();
  Judge judge("room." + c.name);
  judge.compare("", room_replicates(c.variant, 64, 100), oracle_room(c.variant, c.oracle_samples));
  EXPECT_TRUE(judge.verdict());
}

INSTANTIATE_TEST_SUITE_P(, OracleRoom,
                         ::testing::Values(Case{"area_0_bounces", {.bounces = 0}, 64},                              //
                                           Case{"area_1_bounce", {.bounces = 1}, 32},                               //
                                           Case{"area_2_bounces", {.bounces = 2}, 64},                              //
                                           Case{"area_3_bounces", {.bounces = 3}, 64},                              //
                                           Case{"area_4_bounces", {.bounces = 4}, 64},                              //
                                           Case{"point_0_bounces", {.light = "point", .bounces = 0}, 1},            //
                                           Case{"point_1_bounce", {.light = "point", .bounces = 1}, 32},            //
                                           Case{"point_2_bounces", {.light = "point", .bounces = 2}, 32},           //
                                           Case{"point_3_bounces", {.light = "point", .bounces = 3}, 32},           //
                                           Case{"point_4_bounces", {.light = "point", .bounces = 4}, 32},           //
                                           Case{"area_direct", {.integrator = "direct"}, 32},                       //
                                           Case{"area_whitted", {.integrator = "whitted"}, 32},                     //
                                           Case{"point_whitted", {.light = "point", .integrator = "whitted"}, 32},  //
                                           Case{"area_4_shadow_rays", {.bounces = 2, .shadow_rays = 4}, 64}),
                         kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
