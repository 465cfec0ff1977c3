// The hexagon room as the renderer shows it, against the recursive oracle's.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/room.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

struct Case {
  std::string name;
  std::string oracle_case;
  RoomVariant variant;
  int samples_per_pixel;
  RoomResolution resolution;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class OracleRoom : public ::testing::TestWithParam<Case> {};

TEST_P(OracleRoom, ShowsTheSameRadiance) {
  const Case& c = GetParam();
  statistics::Judge judge("room." + c.name);
  judge.compare("", room_replicates(c.variant, c.samples_per_pixel, 100, c.resolution).estimates(),
                oracle::read_room_reference(c.oracle_case));
  EXPECT_TRUE(judge.verdict());
}

constexpr RoomResolution kFine{};
/// Light from the point's bright spot on the ceiling is found by chance alone: nearly all of the noise.
constexpr RoomResolution kBrightSpot{0.04, 0.2, 0.25, 0.6};
/// The sphere shows that spot, smaller than a pixel.
constexpr RoomResolution kReflectedSpot{0.005, 0.05, 0.1, 0.25};

INSTANTIATE_TEST_SUITE_P(
    , OracleRoom,
    ::testing::Values(
        Case{"area_0_bounces", "area_0_bounces", {.bounces = 0}, 256, kFine},
        Case{"area_1_bounce", "area_1_bounce", {.bounces = 1}, 256, kFine},
        Case{"area_2_bounces", "area_2_bounces", {.bounces = 2}, 1024, kFine},
        Case{"area_3_bounces", "area_3_bounces", {.bounces = 3}, 1024, kFine},
        Case{"area_4_bounces", "area_4_bounces", {.bounces = 4}, 1024, kFine},
        Case{"area_4_shadow_rays", "area_2_bounces", {.bounces = 2, .shadow_rays = 4}, 512, kFine},
        Case{"area_direct", "area_1_bounce", {.integrator = "direct"}, 256, kFine},
        Case{"area_whitted", "area_whitted", {.integrator = "whitted"}, 256, kFine},
        Case{"point_1_bounce", "point_1_bounce", {.light = "point", .bounces = 1}, 256, kFine},
        Case{"point_3_bounces", "point_3_bounces", {.light = "point", .bounces = 3}, 1024, kBrightSpot},
        Case{"point_whitted", "point_whitted", {.light = "point", .integrator = "whitted"}, 256, kReflectedSpot}),
    kParamName);

TEST(RoomWithAPointLight, IsBlackWithoutBounces) {
  const auto picture = picture_of(render_image(load_room({.light = "point", .bounces = 0}), {.samples_per_pixel = 4}));
  for (const auto& pixel : picture.pixels) EXPECT_EQ(pixel, statistics::Picture::Pixel{});
}

}  // namespace
}  // namespace norrsken::end_to_end
