// Renderings that are stopped at any moment: what they say of their error then. A moment is a number of waves, as the passes
// hand them out, so that nothing depends on time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "isa/kernel_testing.h"
#include "render/sample_schedule.h"
#include "render/worker_pool.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kSize = 64;

struct Case {
  std::string name, scene;
  std::vector<std::pair<std::string, std::string>> parameters;
  std::string sampler, integrator;
  bool adaptive = false;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Rendering {
 public:
  Rendering(const ViewedScene& viewed, std::uint64_t seed)
      : view_(viewed.view),
        film_(viewed.scene.tables().tables.film, view_.sampler.kind),
        work_{WorkerPool::grid(view_, kSize, kSize), {0, 1}, {}, {}, {}, {}, {}} {
    view_.sampler.seed += seed;
    work_.progress.resize(work_.grid.tile_count());
    if (view_.integrator.from_lights) film_.add_splats(Splats(view_.film, viewed.scene.tables().tables.filter));
  }

  /// Up to so many waves; all of them if there are no more.
  void run(const RenderOptions& options, std::uint32_t most, std::uint64_t waves) {
    const SampleSchedule schedule(options, most);
    std::optional<SampleGoal> goal = schedule.first(work_.grid);
    while (goal && waves > 0) {
      SampleGoal now = *goal;
      now.of_tile = after_waves(*goal, waves);
      work_.set_goal(now);
      std::atomic<bool> cancelled{false};
      WorkerPool(view_, **usable_kernels(), film_, work_, 2, cancelled).run({std::chrono::seconds(1), [] {
                                                                               return true;
                                                                             }});
      EXPECT_TRUE(work_.done());
      goal = schedule.next(work_.grid, film_, *goal, 0, 0);
    }
  }

  RelativeError error() const { return film_.error({0, 0, kSize, kSize}).relative(); }
  std::uint32_t least() const { return *std::ranges::min_element(work_.progress); }
  double mean_samples() const { return static_cast<double>(work_.samples_done()) / (kSize * kSize); }
  std::array<std::vector<double>, 3> values() const {
    std::array<std::vector<double>, 3> values;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::uint64_t i = 0; i < std::uint64_t{kSize} * kSize; ++i) {
        values[c].push_back(film_.estimate(i, static_cast<int>(c)).mean);
      }
    }
    return values;
  }

 private:
  /// How far the tiles are when so many waves towards a goal are on the film; takes those off `waves`.
  TileProgress after_waves(const SampleGoal& goal, std::uint64_t& waves) const {
    TileProgress progress = work_.progress;
    const SampleRange samples{0, goal.most()};
    for (const WorkPlan& plan :
         plan_passes(work_.grid, samples, cut_for(work_.grid, samples, goal.of_tile, progress))) {
      for (std::uint64_t i = 0; i < plan.wave_count(); ++i) {
        const std::uint64_t area = plan.area_of(i);
        const WaveJob job =
            plan.remaining(plan.wave(i), plan.progress_of(area, progress), plan.progress_of(area, goal.of_tile));
        if (job.sample_count == 0) continue;
        if (waves == 0) return progress;
        --waves;
        plan.set_progress_of(area, plan.end_of(job), progress);
      }
    }
    return progress;
  }

  SceneView view_;
  Film film_;
  Work work_;
};

class Stopped : public ::testing::TestWithParam<Case> {};

TEST_P(Stopped, TellsATrueErrorOrNone) {
  const Case& c = GetParam();
  const auto viewed = view_scene(
      c.scene, AccelKind::planes,
      {.parameters = c.parameters, .integrator = c.integrator, .sampler = c.sampler, .width = kSize, .height = kSize});
  ASSERT_TRUE(viewed);
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  Rendering converged(*viewed, 1000);
  converged.run({}, 1024, kAll);
  const auto truth = converged.values();
  double truth_mean = 0;
  for (const auto& channel : truth) {
    for (const double value : channel) truth_mean += value / (3.0 * kSize * kSize);
  }

  // 4 waves are a sample of each pixel, as long as they take one or two, and then one is.
  constexpr int kStops = 60;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  int told = 0, held = 0;
  std::vector<double> ratios;
  for (int stop = 0; stop < kStops; ++stop) {
    Rendering rendering(*viewed, static_cast<std::uint64_t>(stop));
    const auto waves = static_cast<std::uint64_t>(std::exp(unit(random) * std::log(250.0)));
    rendering.run({.adaptive = c.adaptive}, 64, waves);
    const RelativeError error = rendering.error();
    EXPECT_EQ(error.value >= 0, rendering.least() >= 2)
        << waves << " waves, " << rendering.mean_samples() << " samples";
    if (error.value < 0) continue;
    const auto values = rendering.values();
    double squares = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      for (std::size_t i = 0; i < values[channel].size(); ++i) {
        squares += std::pow(values[channel][i] - truth[channel][i], 2);
      }
    }
    const double measured = std::sqrt(squares / (3.0 * kSize * kSize)) / truth_mean;
    ++told;
    held += error.low <= measured && measured <= error.high ? 1 : 0;
    ratios.push_back(error.value / measured);
  }
  ASSERT_GT(told, kStops / 2);
  ASSERT_LT(told, kStops) << "some stop before";
  std::ranges::sort(ratios);
  std::printf("%s: told in %d of %d, median %.3f of the true one (%.2f to %.2f), %d within their intervals\n",
              c.name.c_str(), told, kStops, ratios[ratios.size() / 2], ratios.front(), ratios.back(), held);
  EXPECT_NEAR(ratios[ratios.size() / 2], 1, 0.1);
  EXPECT_GE(held, 0.9 * told);
}

const Case kCases[] = {
    {"room", "hexagon_room", {{"shadow_rays", "1"}}, "sobol", "path"},
    {"room_independent", "hexagon_room", {{"shadow_rays", "1"}}, "independent", "path"},
    {"room_adaptive", "hexagon_room", {{"shadow_rays", "1"}}, "sobol", "path", true},
    {"room_from_the_lights", "hexagon_room", {{"shadow_rays", "1"}}, "sobol", "ptracer"},
    {"caustic", NORRSKEN_TEST_SCENES "rare_paths.xml", {}, "sobol", "path"},
    {"caustic_adaptive", NORRSKEN_TEST_SCENES "rare_paths.xml", {}, "independent", "path", true},
    {"metal", NORRSKEN_TEST_SCENES "rare_paths.xml", {{"ball", "metal"}}, "sobol", "path"},
};
INSTANTIATE_TEST_SUITE_P(, Stopped, ::testing::ValuesIn(kCases), [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace norrsken
