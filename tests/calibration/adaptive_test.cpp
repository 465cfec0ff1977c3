// Adaptive sampling: the mean over many renderings is that of uniform sampling, and the error smaller.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/end_to_end/rendering.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kRuns = 200, kSamples = 128, kSize = 128;

Scene room() { return load("hexagon_room", {.parameters = {{"shadow_rays", "1"}}, .width = kSize, .height = kSize}); }

RenderOptions options(bool adaptive, std::uint64_t seed) {
  return {.samples_per_pixel = kSamples, .adaptive = adaptive, .seed = seed, .threads = kThreads};
}

/// Its samples go where the noise is, and are as many as asked for.
TEST(Adaptive, SpendsWhatIsAskedForUnevenly) {
  const Image image = render_image(room(), options(true, 1), true);
  double sum = 0, least = kSamples, most = 0;
  for (const float n : image.find("samples")->values) {
    sum += n;
    least = std::min<double>(least, n);
    most = std::max<double>(most, n);
  }
  const double mean = sum / (kSize * kSize);
  EXPECT_LE(mean, kSamples);
  EXPECT_GT(mean, 0.97 * kSamples);
  EXPECT_GE(least, kSamples / 2 - 16);
  EXPECT_LT(least, 0.8 * kSamples);
  EXPECT_GT(most, 1.2 * kSamples);
}

TEST(Adaptive, ThreadsChangeNoBit) {
  const Scene scene = room();
  RenderOptions one = options(true, 5), seven = one;
  one.threads = 1;
  seven.threads = 7;
  EXPECT_TRUE(identical(render_image(scene, one, true), render_image(scene, seven, true)));
}

/// 200 renderings of either kind.
TEST(Adaptive, IsUnbiasedAndBetterThanUniform) {
  const Scene scene = room();
  const std::vector<statistics::Grid> grids = {{1, 1, 0.005}, {2, 2, 0.01}, {4, 4, 0.06}};
  const auto regions = statistics::regions_of(kSize, kSize, grids);
  struct Side {
    statistics::RegionMeans means;
    std::vector<statistics::Picture> pictures;
    double samples = 0;
  };
  Side uniform{statistics::RegionMeans(regions), {}, 0}, adaptive = uniform;
  statistics::Picture truth(kSize, kSize);
  for (int run = 0; run < kRuns; ++run) {
    for (Side* side : {&uniform, &adaptive}) {
      const bool is_adaptive = side == &adaptive;
      const Image image =
          render_image(scene, options(is_adaptive, static_cast<std::uint64_t>(run + (is_adaptive ? 1000 : 0))), true);
      for (const float n : image.find("samples")->values) side->samples += n;
      side->means.add(side->pictures.emplace_back(picture_of(image)));
      for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) truth.pixels[i][c] += side->pictures.back().pixels[i][c] / (2 * kRuns);
      }
    }
  }
  statistics::Judge judge("adaptive.room");
  judge.compare("adaptive", adaptive.means.estimates(), uniform.means.estimates());
  EXPECT_TRUE(judge.verdict());

  const auto error = [&](const Side& side) {
    double squares = 0;
    for (const auto& picture : side.pictures) {
      for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) squares += std::pow(picture.pixels[i][c] - truth.pixels[i][c], 2);
      }
    }
    return squares;
  };
  // Errors' squares fall as samples grow: the product is what an error costs.
  const double cost = error(adaptive) * adaptive.samples / (error(uniform) * uniform.samples);
  std::printf("the same error with %.3f times the samples of uniform sampling\n", cost);
  EXPECT_LT(cost, 1);
}

/// Small images too, whose caustics and highlights are a few pixels wide: noise is where the regions around have none of it.
/// In wide ones of few samples it is where chance has it: samples stay even there, but for a few renderings.
TEST(Adaptive, NeedsNoMoreSamplesThanUniform) {
  struct Case {
    const char* name;
    Scene scene;
    int samples, seeds;
    double most;  ///< of the cost of uniform sampling
  };
  const auto room = [](int width, int height) {
    return load("hexagon_room", {.parameters = {{"shadow_rays", "1"}}, .width = width, .height = height});
  };
  const auto wide = [](int width, int height) {
    return load_test_scene_with("rare_paths.xml", {.parameters = {}, .width = width, .height = height});
  };
  const Case cases[] = {{"caustic", load_test_scene("rare_paths.xml"), 64, 24, 0.8},
                        {"metal", load_test_scene("rare_paths.xml", {{"ball", "metal"}}), 64, 24, 0.8},
                        {"room", room(64, 64), 64, 24, 0.95},
                        {"wide caustic", wide(160, 24), 32, 100, 1.05},
                        {"wider caustic", wide(200, 20), 64, 100, 1.05},
                        {"wide room", room(160, 24), 32, 24, 1}};
  for (const Case& c : cases) {
    const auto truth = picture_of(render_image(c.scene, {.samples_per_pixel = 8192, .seed = 999, .threads = kThreads}));
    double cost[2] = {};
    for (const bool adaptive : {false, true}) {
      for (int seed = 0; seed < c.seeds; ++seed) {
        // The same seeds, so that what differs is where the samples are.
        const Image image = render_image(c.scene,
                                         {.samples_per_pixel = c.samples,
                                          .adaptive = adaptive,
                                          .seed = static_cast<std::uint64_t>(seed),
                                          .threads = kThreads},
                                         true);
        const auto picture = picture_of(image);
        double squares = 0, samples = 0;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
          for (std::size_t k = 0; k < 3; ++k) squares += std::pow(picture.pixels[i][k] - truth.pixels[i][k], 2);
        }
        for (const float n : image.find("samples")->values) samples += static_cast<double>(n);
        cost[adaptive] += squares * samples;
      }
    }
    std::printf("%s: the same error with %.3f times the samples of uniform sampling\n", c.name, cost[1] / cost[0]);
    EXPECT_LT(cost[1], c.most * cost[0]) << c.name;
  }
}

}  // namespace
}  // namespace norrsken::end_to_end
