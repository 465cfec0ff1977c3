// Renderings that end at an error or a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <thread>

#include "tests/end_to_end/rendering.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

Scene room(int size, const std::string& sampler = "sobol") {
  return load("hexagon_room",
              {.parameters = {{"shadow_rays", "1"}}, .sampler = sampler, .width = size, .height = size});
}

struct Outcome {
  RenderStatistics statistics;
  Image image;
  double samples_per_pixel = 0;
};

std::unique_ptr<Render> create(const Scene& scene, const RenderOptions& options) {
  Diagnostics diagnostics;
  auto render = told(Render::create(scene, options), diagnostics);
  if (!render) throw std::runtime_error(to_text(diagnostics.all().front()));
  return render;
}

Outcome render(const Scene& scene, const RenderOptions& options) {
  const auto rendering = create(scene, options);
  Outcome outcome{rendering->run(), rendering->image(true)};
  outcome.samples_per_pixel =
      static_cast<double>(outcome.statistics.samples) / (outcome.image.width * outcome.image.height);
  return outcome;
}

/// As many samples as there are in every pixel; fails if pixels have different numbers.
float even_samples(const Image& image) {
  const std::vector<float>& samples = image.find("samples")->values;
  for (const float n : samples) EXPECT_EQ(n, samples.front());
  return samples.front();
}

TEST(TargetError, IsReachedByWholeBlocksAndNotOverdone) {
  for (const char* sampler : {"independent", "sobol"}) {
    const Scene scene = room(80, sampler);
    const Outcome outcome = render(scene, {.target_error = 0.15, .threads = kThreads});
    EXPECT_FALSE(outcome.statistics.cancelled);
    EXPECT_LE(outcome.statistics.error.high, 0.15);
    const float samples = even_samples(outcome.image);
    EXPECT_EQ(std::fmod(samples, 16), 0) << samples;
    // Two blocks less would not have been enough.
    const Outcome fewer = render(scene, {.samples_per_pixel = static_cast<int>(samples) - 32, .threads = kThreads});
    EXPECT_GT(fewer.statistics.error.high, 0.15) << sampler << ' ' << samples;
  }
}

TEST(TargetError, GivesTheImageOfThatManySamples) {
  const Scene scene = room(96);
  const Outcome outcome = render(scene, {.target_error = 0.2, .threads = 1});
  const int samples = static_cast<int>(even_samples(outcome.image));
  EXPECT_TRUE(identical(outcome.image, render(scene, {.samples_per_pixel = samples, .threads = kThreads}).image));
}

TEST(TargetError, SamplesThatAreAskedForAreTheMost) {
  const Outcome outcome = render(room(64), {.samples_per_pixel = 40, .target_error = 0.001, .threads = kThreads});
  EXPECT_EQ(even_samples(outcome.image), 40);
  EXPECT_GT(outcome.statistics.error.value, 0.001);
  EXPECT_FALSE(outcome.statistics.cancelled);
}

/// Nothing that is lit can be found.
TEST(TargetError, EndsWithoutLight) {
  const Outcome outcome = render(
      load("hexagon_room",
           {.parameters = {{"bounces", "0"}, {"light", "point"}, {"shadow_rays", "1"}}, .width = 8, .height = 8}),
      {.target_error = 0.01, .threads = kThreads});
  EXPECT_EQ(outcome.statistics.error.value, -1);
  EXPECT_EQ(even_samples(outcome.image), 1024);
}

TEST(TimeLimit, IsKept) {
  for (const bool adaptive : {false, true}) {
    const Outcome outcome = render(room(48), {.seconds = 1, .adaptive = adaptive, .threads = kThreads});
    EXPECT_FALSE(outcome.statistics.cancelled);
    EXPECT_GT(outcome.statistics.seconds, 0.5) << "the time is made use of";
    EXPECT_LT(outcome.statistics.seconds, 3) << "a busy machine may be late, but not by so much";
    EXPECT_GT(outcome.samples_per_pixel, 1);
  }
}

TEST(TimeLimit, EndsAtTheErrorIfThatIsFirst) {
  const Outcome outcome = render(room(64), {.target_error = 0.5, .seconds = 600, .threads = kThreads});
  EXPECT_LT(outcome.statistics.seconds, 60);
  EXPECT_LE(outcome.statistics.error.high, 0.5);
}

TEST(TimeLimit, ProgressTellsTheTimeLeft) {
  const auto rendering = create(room(48), {.seconds = 1.5, .threads = kThreads});
  double last = 0;
  rendering->run([&](const RenderProgress& progress) {
    EXPECT_GE(progress.fraction, last - 1e-9);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
    if (progress.fraction < 1) {
      EXPECT_NEAR(progress.seconds_left, std::max(0.0, 1.5 - progress.elapsed_seconds), 0.05);
    }
  });
  EXPECT_EQ(last, 1);
}

/// Interrupted again and again, resumed each time.
TEST(Steps, InterruptionsChangeNoBit) {
  const Scene scene = room(96);
  const TemporaryFolder folder;
  const std::string file = folder.file("checkpoint");
  for (const bool adaptive : {false, true}) {
    RenderOptions options{.target_error = 0.18, .adaptive = adaptive, .threads = kThreads};
    const Image whole = render(scene, options).image;
    options.checkpoint = file;
    int interruptions = 0;
    for (bool cancelled = true; cancelled; ++interruptions) {
      const auto rendering = create(scene, options);
      std::jthread killer([&](const std::stop_token& stop) {
        for (int i = 0; i < 20 + 20 * interruptions && !stop.stop_requested(); ++i) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (!stop.stop_requested()) rendering->cancel();
      });
      cancelled = rendering->run().cancelled;
      killer.request_stop();
      killer.join();
      if (!cancelled) {
        EXPECT_TRUE(identical(rendering->image(true), whole)) << adaptive;
      }
    }
    EXPECT_GT(interruptions, 1);
    std::filesystem::remove(file);
    std::filesystem::remove(file + ".1");
  }
}

/// What one command has left, another goes on from, whatever it asks for.
TEST(Steps, CheckpointsGoOnByOtherRules) {
  const Scene scene = room(96);
  const TemporaryFolder folder;
  const std::string file = folder.file("checkpoint");
  RenderOptions options{.samples_per_pixel = 64, .adaptive = true, .threads = kThreads};
  options.checkpoint = file;
  const auto go_on = [&](std::optional<int> samples, double error, double seconds, bool adaptive) {
    options.samples_per_pixel = samples;
    options.target_error = error;
    options.seconds = seconds;
    options.adaptive = adaptive;
    const RenderStatistics statistics = create(scene, options)->run();
    EXPECT_FALSE(statistics.cancelled);
    return static_cast<double>(statistics.samples) / (96 * 96);
  };
  EXPECT_GT(go_on(64, 0, 0, true), 60);
  EXPECT_GE(go_on(72, 0.001, 0, false), 72);
  EXPECT_GT(go_on({}, 0, 0.05, false), 72);
  EXPECT_GT(go_on({}, 0.2, 0, true), 72);
  EXPECT_EQ(go_on(500, 0, 0, false), 500);
}

TEST(Steps, ATimeTooShortForOneSampleTakesIt) {
  const Outcome outcome = render(room(400), {.seconds = 1e-6, .threads = kThreads});
  EXPECT_FALSE(outcome.statistics.cancelled);
  EXPECT_EQ(even_samples(outcome.image), 1);
}

TEST(Steps, RefuseWhatHasNoMeaning) {
  const Scene scene = room(8);
  const auto complaint = [&](const RenderOptions& options) {
    Diagnostics diagnostics;
    EXPECT_EQ(told(Render::create(scene, options), diagnostics), nullptr);
    return diagnostics.all().empty() ? "" : diagnostics.all().front().message;
  };
  EXPECT_EQ(complaint({.target_error = 1}), "target error is 1");
  EXPECT_EQ(complaint({.target_error = std::nan("")}), "target error is nan");
  EXPECT_EQ(complaint({.seconds = -1}), "time is -1 s");
  EXPECT_EQ(complaint({.checkpoint_seconds = 0}), "time between checkpoints is 0 s");
  EXPECT_EQ(complaint({.checkpoint_seconds = std::nan("")}), "time between checkpoints is nan s");
  EXPECT_EQ(complaint({.samples = SampleRange{0, 4}, .adaptive = true}), "samples of a range are taken all");
}

}  // namespace
}  // namespace norrsken::end_to_end
