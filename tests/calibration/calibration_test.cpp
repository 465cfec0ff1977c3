// Errors that can be believed: 200 renderings of a scene with different seeds, at 16 and 64 samples per pixel and with both
// samplers. What each says of its own error is held against how far it really is from the mean of all 800, which stand for
// 32,000 samples per pixel.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/rendering.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kRuns = 200;

struct Case {
  std::string name, scene;
  SceneParameters parameters;
  int width = 0, height = 0;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

struct Setting {
  const char* sampler;
  int samples;
};
constexpr Setting kSettings[] = {{"independent", 16}, {"independent", 64}, {"sobol", 16}, {"sobol", 64}};

constexpr const char* kColors[] = {"R", "G", "B"};

/// One image's colours and intervals, channel by channel, and its error.
struct Rendering {
  std::array<std::vector<float>, 3> values, intervals;
  RelativeError error;
};

Rendering render_one(const Scene& scene, const Setting& setting, std::uint64_t seed) {
  Diagnostics diagnostics;
  RenderOptions options;
  options.samples_per_pixel = setting.samples;
  options.seed = seed;
  options.threads = kThreads;
  const auto render = told(Render::create(scene, options), diagnostics);
  Rendering run;
  run.error = render->run().error;
  const Image image = render->image(true);
  for (std::size_t c = 0; c < 3; ++c) {
    run.values[c] = image.find(kColors[c])->values;
    run.intervals[c] = image.find(std::string("interval.") + kColors[c])->values;
  }
  return run;
}

using Truth = std::array<std::vector<double>, 3>;

struct Findings {
  double covered = 0, values = 0;      ///< of pixels' channels
  double predicted = 0, measured = 0;  ///< mean squares of relative errors
  int images_covered = 0;
};

Findings look_at(const std::vector<Rendering>& runs, const Truth& truth) {
  Findings found;
  double mean = 0;
  for (const auto& channel : truth) {
    for (const double value : channel) mean += value / static_cast<double>(3 * channel.size());
  }
  for (const Rendering& run : runs) {
    double squares = 0, count = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < truth[c].size(); ++i) {
        const double off = run.values[c][i] - truth[c][i];
        squares += off * off;
        ++count;
        // Where there is no noise there is no interval, but single precision rounds.
        found.covered += std::abs(off) <= static_cast<double>(run.intervals[c][i]) + 1e-5 * truth[c][i] ? 1 : 0;
      }
    }
    const double error = std::sqrt(squares / count) / mean;
    found.values += count;
    found.predicted += run.error.value * run.error.value / kRuns;
    found.measured += error * error / kRuns;
    if (run.error.low <= error && error <= run.error.high) ++found.images_covered;
  }
  return found;
}

class Calibration : public ::testing::TestWithParam<Case> {};

TEST_P(Calibration, WhatImagesSayOfTheirErrorsIsTrue) {
  const Case& c = GetParam();
  std::vector<std::vector<Rendering>> all;
  Truth truth;
  double samples = 0;
  for (std::size_t k = 0; k < std::size(kSettings); ++k) {
    const Setting& setting = kSettings[k];
    const Scene scene =
        load(c.scene, {.parameters = c.parameters, .sampler = setting.sampler, .width = c.width, .height = c.height});
    std::vector<Rendering>& runs = all.emplace_back();
    for (int i = 0; i < kRuns; ++i) {
      const Rendering& run =
          runs.emplace_back(render_one(scene, setting, 1000 * (k + 1) + static_cast<std::uint64_t>(i)));
      samples += setting.samples;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        truth[channel].resize(run.values[channel].size());
        for (std::size_t j = 0; j < truth[channel].size(); ++j) {
          truth[channel][j] += static_cast<double>(run.values[channel][j]) * setting.samples;
        }
      }
    }
  }
  for (auto& channel : truth) {
    for (double& value : channel) value /= samples;
  }
  for (std::size_t k = 0; k < std::size(kSettings); ++k) {
    const Setting& setting = kSettings[k];
    const Findings found = look_at(all[k], truth);
    const double share = found.covered / found.values, ratio = std::sqrt(found.predicted / found.measured);
    std::printf(
        "%s, %s, %d samples: %.1f %% of pixels within their intervals, image's error predicted %.3f times as "
        "large as measured, within its interval in %d of %d\n",
        c.name.c_str(), setting.sampler, setting.samples, 100 * share, ratio, found.images_covered, kRuns);
    EXPECT_GE(share, 0.93) << setting.sampler << setting.samples;
    EXPECT_LE(share, 0.97) << setting.sampler << setting.samples;
    EXPECT_NEAR(ratio, 1, 0.1) << setting.sampler << setting.samples;
    EXPECT_GE(found.images_covered, 0.95 * kRuns) << setting.sampler << setting.samples;
  }
}

const Case kCases[] = {
    {"room", "hexagon_room", {{"shadow_rays", "1"}}, 96, 96},
    {"materials", NORRSKEN_SCENES "gallery_materials.xml", {}, 96, 54},
    {"lights", NORRSKEN_SCENES "gallery_lights.xml", {}, 96, 54},
};
INSTANTIATE_TEST_SUITE_P(, Calibration, ::testing::ValuesIn(kCases), kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
