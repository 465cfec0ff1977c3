// Paths from the lights (ptracer) against paths from the camera, and against scenes known in closed form.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/closed_form/closed_form.h"
#include "tests/closed_form/plane_scene.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/rendering.h"
#include "tests/end_to_end/reported_variance.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

using closed_form::PlaneScene;
using statistics::Grid;
using statistics::Judge;
using statistics::Picture;
using statistics::RegionEstimates;

constexpr int kSize = 16;  ///< of the images of light_paths.xml, plane.xml and box.xml
constexpr int kSeeds = 24;

RegionEstimates estimates(const Scene& scene, int samples_per_pixel, std::uint64_t first_seed, double resolution,
                          int size = kSize) {
  return render_replicates(
             scene, {.samples_per_pixel = samples_per_pixel, .threads = kThreads}, kSeeds,
             statistics::regions_of(size, size, std::array{Grid{1, 1, resolution}, Grid{2, 2, 4 * resolution}}),
             first_seed)
      .estimates();
}

struct Case {
  std::string name;
  SceneParameters parameters;
  double resolution = 0.01;
  int size = kSize;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class LightPaths : public ::testing::TestWithParam<Case> {};

TEST_P(LightPaths, AgreeWithPathsFromTheCamera) {
  const Case& c = GetParam();
  SceneParameters from_camera = c.parameters;
  from_camera.emplace_back("integrator", "path");
  Judge judge("light_paths." + c.name);
  judge.compare("", estimates(load_test_scene("light_paths.xml", c.parameters), 3072, 1, c.resolution, c.size),
                estimates(load_test_scene("light_paths.xml", from_camera), 1024, 1000, c.resolution, c.size));
  EXPECT_TRUE(judge.verdict());
}

INSTANTIATE_TEST_SUITE_P(
    , LightPaths,
    ::testing::Values(Case{"room", {}}, Case{"direct", {{"max_depth", "2"}}},
                      Case{"roulette", {{"max_depth", "-1"}, {"rr_depth", "1"}}},
                      Case{"hidden_emitters", {{"hide_emitters", "true"}}},
                      Case{"outdoors", {{"contents", "outdoors"}}}, Case{"glass", {{"contents", "glass"}}, 0.03},
                      Case{"lights", {{"contents", "lights"}}, 0.03}, Case{"near_far", {{"sensor", "near_far"}}, 0.015},
                      Case{"thinlens", {{"sensor", "thinlens"}}, 0.015},
                      Case{"orthographic", {{"sensor", "orthographic"}}, 0.03},
                      Case{"crop", {{"sensor", "crop"}}, 0.02, 8}, Case{"border", {{"sensor", "border"}}, 0.02}),
    kParamName);

TEST(LightPathsOnPlane, HaveTheLightOfTheClosedForm) {
  const Scene scene = load_test_scene_with("plane.xml", {.parameters = {{"light", "all"}}, .integrator = "ptracer"});
  const auto regions = statistics::regions_of(kSize, kSize, std::array{Grid{1, 1, 0.01}, Grid{2, 2, 0.04}});
  Judge judge("light_paths.plane");
  judge.compare("", estimates(scene, 2048, 1, 0.01),
                RegionEstimates::known(PlaneScene::image(PlaneScene::Light::all, kSize, kSize), regions));
  EXPECT_TRUE(judge.verdict());
}

TEST(LightPathsInUniformRoom, AreAGeometricSeries) {
  const auto regions = statistics::regions_of(kSize, kSize, std::array{Grid{1, 1, 0.005}, Grid{2, 2, 0.02}});
  Judge judge("light_paths.uniform");
  for (const int max_depth : {2, 6}) {
    Picture expected(kSize, kSize);
    for (Picture::Pixel& pixel : expected.pixels) {
      pixel = {closed_form::uniform_room_radiance(1, 0.5, max_depth - 1),
               closed_form::uniform_room_radiance(2, 0.8, max_depth - 1),
               closed_form::uniform_room_radiance(0.5, 0.2, max_depth - 1)};
    }
    for (const char* contents : {"uniform", "uniform_sphere"}) {
      const Scene scene = load_test_scene_with(
          "box.xml",
          {.parameters = {{"contents", contents}, {"max_depth", std::to_string(max_depth)}}, .integrator = "ptracer"});
      judge.compare(std::string(contents) + ", max_depth " + std::to_string(max_depth), estimates(scene, 256, 1, 0.005),
                    RegionEstimates::known(expected, regions));
    }
  }
  EXPECT_TRUE(judge.verdict());
}

TEST(LightPathsOfDepthOne, ShowEmittersExactly) {
  const Scene scene = load_test_scene_with(
      "box.xml", {.parameters = {{"contents", "uniform"}, {"max_depth", "1"}}, .integrator = "ptracer"});
  for (const Picture::Pixel& pixel : picture_of(render_image(scene, {.samples_per_pixel = 3})).pixels) {
    EXPECT_EQ(pixel, (Picture::Pixel{1, 2, 0.5}));
  }
}

/// Long paths in a bright room, whose splats do not fit a wave's memory at once.
TEST(LightPathsOfAnyNumberOfThreads, LeaveTheSameBits) {
  for (const char* sampler : {"independent", "sobol"}) {
    const Scene scene = load_test_scene_with(
        "light_paths.xml", {.parameters = {{"max_depth", "40"}, {"sensor", "border"}}, .sampler = sampler});
    const Image one = render_image(scene, {.samples_per_pixel = 37, .threads = 1}, true);
    for (const int threads : {2, 5}) {
      const Image many = render_image(scene, {.samples_per_pixel = 37, .threads = threads}, true);
      for (std::size_t i = 0; i < one.channels.size(); ++i) {
        EXPECT_TRUE(many.channels[i].values == one.channels[i].values) << one.channels[i].name << ", " << threads;
      }
    }
  }
}

/// Images of different seeds differ as much as each says of itself.
TEST(LightPathsError, IsThatOfImagesOfDifferentSeeds) {
  statistics::StatisticalTest test;
  for (const char* sampler : {"independent", "sobol"}) {
    const Scene scene = load_test_scene_with("light_paths.xml", {.parameters = {}, .sampler = sampler});
    EXPECT_TRUE(reports_its_variance(test, 0.1, scene, {.samples_per_pixel = 32, .seed = 100}, 96, sampler));
  }
}

}  // namespace
}  // namespace norrsken::end_to_end
