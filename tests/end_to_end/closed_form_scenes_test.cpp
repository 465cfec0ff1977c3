// The renderer against scenes whose light is known: a lit plane, closed rooms, a mirror.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/closed_form/closed_form.h"
#include "tests/closed_form/plane_scene.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/rendering.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

using closed_form::PlaneScene;
using statistics::Judge;
using statistics::Picture;
using statistics::RegionEstimates;

constexpr int kSize = 16;  ///< of the images of plane.xml and box.xml
constexpr int kSeeds = 24;

RegionEstimates estimates(const Scene& scene, int samples_per_pixel,
                          std::vector<statistics::Region> regions = statistics::standard_regions(kSize, kSize)) {
  return render_replicates(scene, {.samples_per_pixel = samples_per_pixel, .threads = kThreads}, kSeeds,
                           std::move(regions))
      .estimates();
}

RegionEstimates known(const Picture& picture) {
  return RegionEstimates::known(picture, statistics::standard_regions(kSize, kSize));
}

struct PlaneCase {
  std::string name;
  PlaneScene::Light light;
  SceneParameters parameters;
};

std::ostream& operator<<(std::ostream& out, const PlaneCase& c) { return out << c.name; }

class Plane : public ::testing::TestWithParam<PlaneCase> {};

TEST_P(Plane, HasTheLightOfTheClosedForm) {
  const PlaneCase& c = GetParam();
  Judge judge("plane." + c.name);
  judge.compare("", estimates(load_test_scene("plane.xml", c.parameters), 256),
                known(PlaneScene::image(c.light, kSize, kSize)));
  EXPECT_TRUE(judge.verdict());
}

INSTANTIATE_TEST_SUITE_P(
    , Plane,
    ::testing::Values(PlaneCase{"point", PlaneScene::Light::point, {{"light", "point"}}},
                      PlaneCase{"rectangle", PlaneScene::Light::rectangle, {{"light", "rectangle"}}},
                      PlaneCase{"triangle", PlaneScene::Light::triangle, {{"light", "triangle"}}},
                      PlaneCase{"sphere", PlaneScene::Light::sphere, {{"light", "sphere"}}},
                      PlaneCase{"all_path", PlaneScene::Light::all, {{"light", "all"}, {"emitter_samples", "3"}}},
                      PlaneCase{"all_direct", PlaneScene::Light::all, {{"light", "all"}, {"integrator", "direct"}}},
                      PlaneCase{"all_whitted", PlaneScene::Light::all, {{"light", "all"}, {"integrator", "whitted"}}}),
    kParamName);

TEST(PlaneFromBelow, IsBlackUnlessTwoSided) {
  const RenderOptions options{.samples_per_pixel = 16, .threads = kThreads};
  const Picture one_sided =
      picture_of(render_image(load_test_scene("plane_from_below.xml", {{"material", "one_sided"}}), options));
  for (const Picture::Pixel& pixel : one_sided.pixels) EXPECT_EQ(pixel, Picture::Pixel{});

  // From below with +y up, +x is to the left.
  const Picture above = PlaneScene::image(PlaneScene::Light::point, kSize, kSize);
  Picture below(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) below.at(x, y) = above.at(kSize - 1 - x, y);
  }
  Judge judge("plane.two_sided_from_below");
  judge.compare("", estimates(load_test_scene("plane_from_below.xml", {{"material", "two_sided"}}), 256), known(below));
  EXPECT_TRUE(judge.verdict());
}

class UniformRoom : public ::testing::TestWithParam<const char*> {};

TEST_P(UniformRoom, IsAGeometricSeriesToTheChosenDepth) {
  const std::string contents = GetParam();
  Judge judge("closed_room." + contents);
  for (const int max_depth : {1, 2, 3, 4, 6}) {
    Picture expected(kSize, kSize);
    for (Picture::Pixel& pixel : expected.pixels) {
      pixel = {closed_form::uniform_room_radiance(1, 0.5, max_depth - 1),
               closed_form::uniform_room_radiance(2, 0.8, max_depth - 1),
               closed_form::uniform_room_radiance(0.5, 0.2, max_depth - 1)};
    }
    const Scene scene = load_test_scene("box.xml", {{"contents", contents}, {"max_depth", std::to_string(max_depth)}});
    judge.compare("max_depth " + std::to_string(max_depth), estimates(scene, 128), known(expected));
  }
  EXPECT_TRUE(judge.verdict());
}

INSTANTIATE_TEST_SUITE_P(, UniformRoom, ::testing::Values("uniform", "uniform_sphere"), kParamName);

TEST(EmittersOnly, AreShownExactly) {
  const Scene scene = load_test_scene("box.xml", {{"contents", "uniform"}, {"max_depth", "1"}});
  const Picture picture = picture_of(render_image(scene, {.samples_per_pixel = 7, .threads = kThreads}));
  for (const Picture::Pixel& pixel : picture.pixels) EXPECT_EQ(pixel, (Picture::Pixel{1, 2, 0.5}));
}

class Mirror : public ::testing::TestWithParam<const char*> {};

TEST_P(Mirror, ShowsExactlyWhatItFaces) {
  // The mirrored camera sends each pixel's samples along the mirror images of the camera's rays, and the direct light
  // of a point takes no random numbers, so every pixel must come out the same but for rounding.
  const auto view = [&](const char* name) {
    return picture_of(
        render_image(load_test_scene("mirror.xml", {{"view", name}, {"integrator", "whitted"}}),
                     {.samples_per_pixel = 16, .seed = 5, .threads = kThreads, .accelerator = GetParam()}));
  };
  const Picture in_mirror = view("in_mirror"), direct = view("direct");
  double brightest = 0;
  std::size_t lit_pixels = 0;
  for (const Picture::Pixel& pixel : direct.pixels) {
    brightest = std::max(brightest, pixel[1]);
    lit_pixels += pixel[1] > 0 ? 1 : 0;
  }
  EXPECT_GT(lit_pixels, direct.pixels.size() / 2);
  EXPECT_LT(lit_pixels, direct.pixels.size()) << "an edge should be in view";
  for (int y = 0; y < direct.height; ++y) {
    for (int x = 0; x < direct.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(in_mirror.at(x, y)[c], direct.at(x, y)[c], 1e-5 * brightest) << "pixel " << x << ", " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Mirror, ::testing::Values("planes", "moller_trumbore", "bvh", "embree"), kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
