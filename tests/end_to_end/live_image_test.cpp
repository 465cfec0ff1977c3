// Images of renderings that are under way: asked for by other threads while the workers work.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "tests/end_to_end/rendering.h"
#include "tests/temporary_folder.h"

namespace norrsken::end_to_end {
namespace {

/// Every sample of every pixel sees nothing but the surroundings, so that an image of whole samples is 2 wherever it has one.
constexpr const char* kSky = R"(<scene version="3.0.0"><integrator type="%"/><sensor type="perspective">
  <film type="hdrfilm"><integer name="width" value="96"/><integer name="height" value="80"/><rfilter type="box"/></film>
  <sampler type="independent"/></sensor><shape type="sphere"><point name="center" x="0" y="0" z="-9"/></shape>
  <emitter type="constant"><float name="radiance" value="2"/></emitter></scene>)";

Scene sky() {
  std::string xml = kSky;
  xml.replace(xml.find('%'), 1, "path");
  return *Scene::load(SceneSource::memory("sky.xml", xml));
}

std::unique_ptr<Render> create(const Scene& scene, RenderOptions options) {
  options.threads = 2;
  auto render = Render::create(scene, options);
  EXPECT_TRUE(render) << render.error();
  return *std::move(render);
}

/// Calls `look` from two other threads until the rendering is over.
template <class Look>
RenderStatistics run_watched(Render& render, const Look& look) {
  std::atomic<bool> over{false};
  std::vector<std::jthread> watchers;
  for (int i = 0; i < 2; ++i) {
    watchers.emplace_back([&, i] {
      while (!over) look(i);
    });
  }
  const RenderStatistics statistics = render.run();
  over = true;
  return statistics;
}

TEST(LiveImage, IsOfWholeSamples) {
  const auto render = create(sky(), {.samples_per_pixel = 200, .features = true});
  std::atomic<int> images{0}, wrong{0};
  std::atomic<float> most{0};
  run_watched(*render, [&](int i) {
    const bool layers = i == 0;
    const Image image = render->image(layers);
    const std::vector<float>& red = image.find("R")->values;
    for (std::size_t pixel = 0; pixel < red.size(); ++pixel) {
      if (layers) {
        const float samples = image.find("samples")->values[pixel];
        if ((samples > 0 ? 2.0f : 0.0f) != red[pixel]) ++wrong;
        const float variance = image.find("variance.R")->values[pixel];
        if (samples > 1 && !(variance == 0)) ++wrong;
        if (samples > most) most = samples;
      } else if (red[pixel] != 0 && red[pixel] != 2) {
        ++wrong;
      }
    }
    ++images;
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(images, 2);
  const Image last = render->image(true);
  EXPECT_TRUE(std::ranges::all_of(last.find("samples")->values, [](float s) { return s == 200; }));
  EXPECT_NE(last.find("depth.Z"), nullptr);
}

TEST(LiveImage, DoesNotChangeTheRendering) {
  for (const char* integrator : {"path", "ptracer"}) {
    const Scene room = load(
        "hexagon_room", {.parameters = {{"shadow_rays", "1"}}, .integrator = integrator, .width = 48, .height = 48});
    const RenderOptions options{.samples_per_pixel = 24};
    const auto render = create(room, options);
    run_watched(*render, [&](int i) { render->image(i == 0); });
    EXPECT_TRUE(identical(render->image(true), render_image(room, options, true))) << integrator;
  }
}

// The camera of a scene lit evenly sees the same radiance by paths from the lights: sums that have more or less than their
// number of paths would show as a brighter or darker image.
TEST(LiveImage, OfPathsFromTheLightsCountsWhatIsThere) {
  const Scene room = load("hexagon_room", {.parameters = {}, .integrator = "ptracer", .width = 16, .height = 16});
  const auto render = create(room, {.samples_per_pixel = 1500});
  const auto mean = [](const Image& image) {
    double sum = 0;
    for (const float value : image.find("G")->values) sum += double{value};
    return sum / 256;
  };
  std::vector<double> means;
  std::atomic<int> images{0};
  run_watched(*render, [&](int i) {
    const Image image = render->image(true);
    ++images;
    const double samples = double{*std::ranges::min_element(image.find("samples")->values)};
    if (i == 0 && samples >= 200) means.push_back(mean(image));
  });
  const double last = mean(render->image());
  for (const double m : means) EXPECT_NEAR(m / last, 1, 0.1);
  EXPECT_GT(images, 2);
}

TEST(LiveImage, RegionsArePartsOfTheWhole) {
  const Scene room = load("hexagon_room", {.parameters = {{"shadow_rays", "1"}}, .width = 40, .height = 30});
  const auto render = create(room, {.samples_per_pixel = 8, .features = true});
  render->run();
  const Image whole = render->image(true);
  const Image part = render->image(true, ImageRegion{13, 7, 11, 9});
  ASSERT_EQ(part.width, 11);
  ASSERT_EQ(part.height, 9);
  ASSERT_EQ(part.channels.size(), whole.channels.size());
  for (const Channel& channel : part.channels) {
    for (std::size_t y = 0; y < 9; ++y) {
      for (std::size_t x = 0; x < 11; ++x)
        ASSERT_EQ(channel.values[y * 11 + x], whole.find(channel.name)->values[(y + 7) * 40 + x + 13]) << channel.name;
    }
  }
  const Image corner = render->image(false, ImageRegion{35, -5, 100, 10});
  EXPECT_EQ(corner.width, 5);
  EXPECT_EQ(corner.height, 5);
  EXPECT_EQ(render->image(false, ImageRegion{100, 100, 5, 5}).width, 0);
}

TEST(LiveImage, PassesAreTold) {
  const auto render = create(sky(), {.samples_per_pixel = 40, .features = true});
  std::vector<RenderPass> passes;
  std::vector<float> least;
  RenderCallbacks callbacks;
  callbacks.on_pass = [&](const RenderPass& pass) {
    passes.push_back(pass);
    const Image image = render->image(true);
    least.push_back(*std::ranges::min_element(image.find("samples")->values));
    EXPECT_TRUE(!pass.has_layers || image.find("depth.Z") != nullptr);
  };
  render->run(callbacks);
  ASSERT_GE(passes.size(), 3u);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    EXPECT_GE(least[i], static_cast<float>(passes[i].samples));
    EXPECT_TRUE(i == 0 || passes[i].samples >= passes[i - 1].samples);
  }
  EXPECT_NE(std::ranges::find(passes, 1u, &RenderPass::samples), passes.end());
  EXPECT_NE(std::ranges::find(passes, 2u, &RenderPass::samples), passes.end());
  EXPECT_EQ(passes.back().samples, 40u);
  EXPECT_TRUE(passes.back().has_layers);
}

TEST(LiveImage, AnyThreadCancelsAndTheImageStays) {
  const auto render = create(sky(), {.samples_per_pixel = 2000000000});
  std::jthread canceller;
  RenderCallbacks callbacks;
  callbacks.on_pass = [&](const RenderPass& pass) {
    if (pass.samples >= 1 && !canceller.joinable()) canceller = std::jthread([&] { render->cancel(); });
  };
  const RenderStatistics statistics = render->run(callbacks);
  EXPECT_TRUE(statistics.cancelled);
  const Image image = render->image();
  EXPECT_TRUE(std::ranges::all_of(image.find("R")->values, [](float v) { return v == 2; }));
  EXPECT_EQ(image.metadata.at("norrsken.interrupted"), "true");
}

TEST(LiveImage, IsThereBeforeTheFirstSample) {
  const auto render = create(sky(), {});
  const Image image = render->image(true);
  EXPECT_EQ(image.width, 96);
  EXPECT_EQ(image.find("samples")->values.at(0), 0);
}

}  // namespace
}  // namespace norrsken::end_to_end
