// The oracle against scenes whose light is known, and its two ways of finding lights against each other.
#include "tests/oracle/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/closed_form/closed_form.h"
#include "tests/closed_form/plane_scene.h"
#include "tests/oracle/room_reference.h"
#include "tests/statistics/judge.h"

namespace norrsken::oracle {
namespace {

using closed_form::PlaneScene;
using statistics::Grid;
using statistics::Judge;
using statistics::Picture;
using statistics::RegionEstimates;

constexpr int kSize = 16;
constexpr Sampling kSampling{.width = kSize, .height = kSize, .strata = 2};

RegionEstimates estimates(const Scene& scene, const Camera& camera, const Settings& settings, int strata,
                          std::vector<statistics::Region> regions = statistics::standard_regions(kSize, kSize)) {
  return estimate(scene, camera, settings, {.width = kSize, .height = kSize, .strata = strata, .replicates = 32},
                  std::move(regions));
}

RegionEstimates known(PlaneScene::Light light) {
  return RegionEstimates::known(PlaneScene::image(light, kSize, kSize), statistics::standard_regions(kSize, kSize));
}

Scene plane() {
  Scene scene;
  scene.add_parallelogram({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, {0, 0, 1},
                          {Material::Kind::diffuse, PlaneScene::kAlbedo});
  return scene;
}

TEST(Intersection, TriangleIsHitWhereItsBarycentricsSay) {
  const Triangle triangle{{1, 0, 2}, {4, 1, 2}, {2, 3, 5}, {}, {}, {}};
  const Vec origin{7, -3, 9};
  for (const auto& [u, v] : {std::pair{0.2, 0.3}, std::pair{0.9, 0.05}, std::pair{0.01, 0.98}}) {
    const Vec target = (1 - u - v) * triangle.v0 + u * triangle.v1 + v * triangle.v2;
    const auto t = intersect(triangle, {origin, 0.25 * (target - origin)});
    ASSERT_TRUE(t);
    EXPECT_NEAR(*t, 4, 1e-12);
  }
  for (const auto& [u, v] : {std::pair{-0.01, 0.3}, std::pair{0.3, -0.01}, std::pair{0.6, 0.41}}) {
    const Vec target = (1 - u - v) * triangle.v0 + u * triangle.v1 + v * triangle.v2;
    EXPECT_FALSE(intersect(triangle, {origin, target - origin}));
  }
}

TEST(Intersection, SphereIsEnteredAtTheNearSide) {
  const Sphere sphere{{1, 2, 3}, 0.5, {}};
  EXPECT_NEAR(intersect(sphere, {{1, 2, 8}, {0, 0, -2}}).value(), 2.25, 1e-12);
  EXPECT_NEAR(intersect(sphere, {{1.3, 2, 8}, {0, 0, -1}}).value(), 4.6, 1e-12);
  EXPECT_FALSE(intersect(sphere, {{1.51, 2, 8}, {0, 0, -1}}));
}

TEST(Room, IsClosedAndFacesInward) {
  const Scene room = hexagon_room(RoomLight::area);
  EXPECT_EQ(room.triangles.size(), 24u + 4u + 2u);
  Random random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const Vec direction{normal(random), normal(random), normal(random)};
    const auto hit = closest_hit(room, {{-1, 0, 0}, direction});
    ASSERT_TRUE(hit);
    EXPECT_LT(dot(direction, hit->normal), 0);
  }
}

TEST(Room, CameraSeesTheGreenWallsSidesTheRightWayRound) {
  // At mid-height the camera sees, from left to right, the third and fourth wall in the middle (blue) and the second
  // and fifth (green) to the sides; the mirror sphere is to the right, below the middle, where y is negative.
  const Scene room = hexagon_room(RoomLight::point);
  const Camera camera = hexagon_room_camera();
  const auto seen = [&](double fx, double fy) {
    return closest_hit(room, {camera.eye, camera.top_left + fx * camera.across + fy * camera.down - camera.eye});
  };
  EXPECT_DOUBLE_EQ(seen(0.5, 0.45)->material.albedo.z, 0.8);
  EXPECT_DOUBLE_EQ(seen(0.05, 0.5)->material.albedo.y, 0.8);
  EXPECT_DOUBLE_EQ(seen(0.95, 0.5)->material.albedo.y, 0.8);
  EXPECT_EQ(seen(0.65, 0.62)->material.kind, Material::Kind::mirror);
}

TEST(Oracle, PointLightOverPlane) {
  Scene scene = plane();
  scene.point_lights.push_back(PlaneScene::kPoint);
  Judge judge("oracle.point_light_over_plane");
  judge.compare("", estimates(scene, PlaneScene::kCamera, {.bounces = 1}, 4), known(PlaneScene::Light::point));
  EXPECT_TRUE(judge.verdict());
}

TEST(Oracle, RectangleOverPlane) {
  Scene scene = plane();
  const auto& corner = PlaneScene::kRectangle;
  scene.add_parallelogram(corner[0], corner[1] - corner[0], corner[3] - corner[0], {0, 0, 0}, {},
                          PlaneScene::kRectangleRadiance);
  Judge judge("oracle.rectangle_over_plane");
  judge.compare("", estimates(scene, PlaneScene::kCamera, {.bounces = 2, .light_rays = 4}, 8),
                known(PlaneScene::Light::rectangle));
  EXPECT_TRUE(judge.verdict());
}

TEST(Oracle, UniformRoomIsAGeometricSeries) {
  const Rgb emission{1, 2, 0.5}, albedo{0.5, 0.8, 0.2};
  const Scene scene = closed_box({Material::Kind::diffuse, albedo}, emission);
  const auto regions = statistics::regions_of(kSize, kSize, std::array{Grid{1, 1, 0.005}, Grid{2, 2, 0.01}});
  Judge judge("oracle.uniform_room");
  for (int bounces = 0; bounces < 4; ++bounces) {
    Picture expected(kSize, kSize);
    for (Picture::Pixel& pixel : expected.pixels) {
      pixel = {closed_form::uniform_room_radiance(emission.x, albedo.x, bounces),
               closed_form::uniform_room_radiance(emission.y, albedo.y, bounces),
               closed_form::uniform_room_radiance(emission.z, albedo.z, bounces)};
    }
    judge.compare(std::to_string(bounces) + " bounces",
                  estimates(scene, kInsideBoxCamera, {.bounces = bounces, .light_rays = 0}, 12, regions),
                  RegionEstimates::known(expected, regions));
  }
  EXPECT_TRUE(judge.verdict());
}

TEST(Oracle, MirrorShowsWhatItFaces) {
  // A mirror in the plane x = 0 against the view of the mirrored camera from behind it. Both take the same random
  // numbers for the film position, and direct light of a point needs none.
  Scene scene;
  scene.add_parallelogram({4, -3, -3}, {0, 6, 0}, {0, 0, 3}, {}, {Material::Kind::diffuse, {0.2, 0.5, 0.9}});
  scene.add_parallelogram({3, -3, -3}, {0, 6, 0}, {1, 0, 6}, {}, {Material::Kind::diffuse, {0.9, 0.5, 0.2}});
  scene.point_lights.push_back({{1, 0.5, 0.5}, {1, 2, 3}});
  const Camera camera{{2, 0.1, 0.2}, {1, -0.9, 1.2}, {0, 2, 0}, {0, 0, -2}};
  const auto mirrored = [](const Vec& v) { return Vec{-v.x, v.y, v.z}; };
  const Camera behind{mirrored(camera.eye), mirrored(camera.top_left), mirrored(camera.across), mirrored(camera.down)};
  const Picture direct = render(scene, behind, {.bounces = 1, .diffuse_bounces = false}, kSampling, 3);
  scene.add_parallelogram({0, -9, -9}, {0, 18, 0}, {0, 0, 18}, {1, 0, 0}, {Material::Kind::mirror, {}});
  const Picture in_mirror = render(scene, camera, {.bounces = 2, .diffuse_bounces = false}, kSampling, 3);
  double brightest = 0, largest_difference = 0;
  for (std::size_t i = 0; i < direct.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      brightest = std::max(brightest, direct.pixels[i][c]);
      largest_difference = std::max(largest_difference, std::abs(in_mirror.pixels[i][c] - direct.pixels[i][c]));
    }
  }
  EXPECT_GT(brightest, 0.01);
  EXPECT_LT(largest_difference, 1e-12);
}

TEST(Oracle, ShadowRaysAgreeWithChanceHits) {
  const Scene scene = lamp_box();
  const auto regions = statistics::regions_of(kSize, kSize, std::array{Grid{1, 1, 0.01}, Grid{2, 2, 0.04}});
  Judge judge("oracle.shadow_rays_against_chance_hits");
  judge.compare("", estimates(scene, kInsideBoxCamera, {.bounces = 3, .light_rays = 1}, 8, regions),
                estimates(scene, kInsideBoxCamera, {.bounces = 3, .light_rays = 0}, 14, regions));
  EXPECT_TRUE(judge.verdict());
}

TEST(Oracle, WhittedStopsAtTheFirstDiffuseHit) {
  Scene room = hexagon_room(RoomLight::area);
  room.spheres.clear();
  const auto whitted = [&](int bounces) {
    return render(room, hexagon_room_camera(), {.bounces = bounces, .diffuse_bounces = false}, kSampling, 5);
  };
  EXPECT_EQ(whitted(5).pixels, whitted(1).pixels);
}

/// All but the 4 x 4 blocks, whose few samples of a caustic are too skewed for a t-test.
RegionEstimates large_regions(RegionEstimates estimates) {
  constexpr std::size_t kLarge = 1 + 2 + 4;
  estimates.regions.resize(kLarge);
  estimates.values.resize(kLarge);
  return estimates;
}

TEST(RoomReference, IsWhatTheOracleSees) {
  constexpr RoomResolution kCoarse{0.1, 0.5, 1, 0};
  Judge judge("oracle.room_reference");
  for (const RoomCase& room : room_cases()) {
    // The point light's bright spot on the ceiling, found by chance, leaves nothing to be told from so few samples.
    if (room.name == "point_3_bounces") continue;
    judge.compare(std::string(room.name), large_regions(estimate_room(room, 3, 16, 1, kCoarse)),
                  large_regions(read_room_reference(room.name)));
  }
  EXPECT_TRUE(judge.verdict());
}

}  // namespace
}  // namespace norrsken::oracle
