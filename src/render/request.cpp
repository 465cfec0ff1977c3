#include "render/request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compile/compile.h"
#include "norrsken/scene.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kFeatureSamples = 16;
/// Of scenes that name layers, where nobody knows how many samples the image will have.
constexpr std::uint32_t kOpenFeatureSamples = 64;

bool needs_all_features(const Scene& scene) {
  return !scene.frame().layers.features.empty() || scene.frame().film.has_alpha();
}

}  // namespace

void check_options(const Scene& scene, const RenderOptions& options, Diagnostics& diagnostics) {
  if (options.samples_per_pixel && *options.samples_per_pixel < 1) {
    diagnostics.error({}, "samples per pixel is " + std::to_string(*options.samples_per_pixel),
                      "an integer from 1 to " + std::to_string(std::numeric_limits<int>::max()));
  }
  if (options.threads < 0 || options.threads > kMaxThreads) {
    diagnostics.error({}, "number of threads is " + std::to_string(options.threads),
                      "0 (one per hardware thread) to " + std::to_string(kMaxThreads));
  }
  if (!(options.target_error >= 0 && options.target_error < 1)) {
    diagnostics.error({}, fmt::format("target error is {}", options.target_error), "more than 0 and less than 1");
  }
  if (!(options.seconds >= 0)) diagnostics.error({}, fmt::format("time is {} s", options.seconds), "more than 0");
  if (!(options.checkpoint_seconds > 0 && std::isfinite(options.checkpoint_seconds))) {
    diagnostics.error({}, fmt::format("time between checkpoints is {} s", options.checkpoint_seconds), "more than 0");
  }
  if (goes_by_steps(options) && options.samples) {
    diagnostics.error({}, "samples of a range are taken all",
                      "no range, or neither an error, nor a time, nor adaptivity");
  }
  if (options.adaptive && scene.frame().integrator.from_lights) {
    diagnostics.error({}, "adaptive sampling with paths that begin at the lights", "another integrator than ptracer");
  }
  if (options.samples && options.samples->first >= options.samples->end) {
    diagnostics.error({}, fmt::format("samples {} to {}", options.samples->first, options.samples->end),
                      "a first sample, and a greater one behind the last");
  }
  if (options.samples && options.samples->end > kMostSamples) {
    diagnostics.error({}, fmt::format("samples end at {}", options.samples->end),
                      fmt::format("up to {}", kMostSamples));
  }
}

FilmSettings film_settings(const Scene& scene) {
  FilmSettings film = scene.frame().film;
  film.opaque = scene.tables().tables.environment != kNone && !scene.frame().integrator.hide_emitters;
  return film;
}

SceneLayers layers(const Scene& scene, const RenderOptions& options) {
  SceneLayers layers = scene.frame().layers;
  if (options.features) {
    for (FeatureLayer& layer : standard_features()) layers.features.push_back(std::move(layer));
  }
  return layers;
}

SampleRange sample_range(const Scene& scene, const RenderOptions& options) {
  if (options.samples) return *options.samples;
  const auto count = options.samples_per_pixel.value_or(static_cast<int>(scene.frame().sampler.samples_per_pixel));
  return {0, static_cast<std::uint32_t>(count)};
}

SampleRange feature_range(const Scene& scene, const RenderOptions& options, SampleRange samples) {
  if (needs_all_features(scene)) {
    return is_open(options) ? SampleRange{samples.first, samples.first + kOpenFeatureSamples} : samples;
  }
  if (!options.features) return {};
  return {std::min(samples.first, kFeatureSamples), std::min(samples.end, kFeatureSamples)};
}

SampleSchedule make_schedule(SampleRange samples, const RenderOptions& options) {
  const bool is_bounded = options.samples_per_pixel || !is_open(options);
  return SampleSchedule(options, is_bounded ? samples.count() : kMostSamples);
}

}  // namespace norrsken
