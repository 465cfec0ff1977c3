#include "norrsken/render.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "compile/compile.h"
#include "isa/entry.h"
#include "render/crew.h"
#include "render/scene_view.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kFeatureSamples = 16;

FilmSettings film_settings(const SceneTables& tables) {
  FilmSettings film = tables.film;
  film.opaque = tables.environment != kNone && !tables.integrator.hide_emitters;
  return film;
}

/// Planes hold polygons, which do not know the triangles that they were merged from.
std::string accelerator_for(const Scene& scene, const RenderOptions& options) {
  const bool counts_triangles = std::ranges::any_of(
      scene.tables().layers.features, [](const FeatureLayer& layer) { return layer.feature == kFeaturePrimitive; });
  return counts_triangles && options.accelerator == "auto" ? "embree" : options.accelerator;
}

SceneLayers layers(const Scene& scene, const RenderOptions& options) {
  SceneLayers layers = scene.tables().layers;
  if (options.features) {
    for (FeatureLayer& layer : standard_features()) layers.features.push_back(std::move(layer));
  }
  return layers;
}

bool needs_all_features(const Scene& scene) {
  return !scene.tables().layers.features.empty() || scene.tables().tables.film.has_alpha();
}

class RenderSession final : public Render {
 public:
  RenderSession(Scene scene, const RenderOptions& options, const KernelEntry& kernels, AccelKind accel_kind)
      : scene_(std::move(scene)),
        tables_(scene_.tables().tables),
        kernels_(kernels),
        accel_(tables_, accel_kind),
        view_(make_scene_view(tables_, accel_.view())),
        threads_(crew_size(options.threads)),
        samples_(static_cast<std::uint64_t>(
            options.samples_per_pixel.value_or(static_cast<int>(view_.sampler.samples_per_pixel)))),
        film_(film_settings(tables_), view_.sampler.kind, layers(scene_, options)),
        needs_all_features_(needs_all_features(scene_)),
        features_(options.features || needs_all_features_) {
    view_.sampler.seed += options.seed;
    if (view_.integrator.from_lights) film_.add_splats(Splats(view_.film, tables_.filter));
  }

  RenderStatistics run(const std::function<void(const RenderProgress&)>& on_progress) override {
    auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    Crew crew(view_, kernels_, film_, threads_, cancelled_);
    const std::uint64_t total = samples_ * film_.width() * film_.height();
    const auto progress = [&] {
      RenderProgress p;
      p.samples_done = crew.samples_done();
      p.samples_total = total;
      p.elapsed_seconds = seconds();
      p.samples_per_second = p.elapsed_seconds > 0 ? static_cast<double>(p.samples_done) / p.elapsed_seconds : 0;
      p.relative_error = crew.relative_error();
      on_progress(p);
    };
    const auto tick = on_progress ? std::function<void()>(progress) : std::function<void()>();
    if (features_) {
      feature_samples_ = static_cast<std::uint32_t>(
          needs_all_features_ ? samples_ : std::min<std::uint64_t>(samples_, kFeatureSamples));
      crew.run_features(feature_samples_, tick);
      begin = std::chrono::steady_clock::now();  // figures are those of the image, not of its layers
    }
    crew.run(samples_, tick);

    RenderStatistics s = crew.statistics();
    s.seconds = seconds();
    s.cancelled = s.samples < total;
    s.relative_error = film_.error({0, 0, film_.width(), film_.height()}).relative();
    s.isa = kernels_.name;
    s.lanes = static_cast<int>(kernels_.lanes);
    s.accelerator = accel_name(view_.accel.kind);
    if (on_progress) {
      on_progress(
          {s.samples, total, s.seconds, static_cast<double>(s.samples) / std::max(s.seconds, 1e-9), s.relative_error});
    }
    return s;
  }

  void cancel() noexcept override { cancelled_.store(true, std::memory_order_relaxed); }

  Image image(bool statistics) const override { return film_.image(statistics, feature_samples_); }

 private:
  Scene scene_;
  const SceneTables& tables_;
  const KernelEntry& kernels_;
  Accel accel_;
  SceneView view_;
  int threads_;
  std::uint64_t samples_;
  Film film_;
  bool needs_all_features_;  ///< of as many samples as the image: the scene itself asks for them
  bool features_;
  std::uint32_t feature_samples_ = 0;
  std::atomic<bool> cancelled_{false};
};

}  // namespace

std::unique_ptr<Render> Render::create(const Scene& scene, const RenderOptions& options, Diagnostics& diagnostics) {
  const KernelEntry* kernels = choose_kernels(options.isa, diagnostics);
  if (options.samples_per_pixel && *options.samples_per_pixel < 1) {
    diagnostics.error({}, "samples per pixel is " + std::to_string(*options.samples_per_pixel),
                      "an integer from 1 to " + std::to_string(std::numeric_limits<int>::max()));
  }
  if (options.threads < 0 || options.threads > kMaxThreads) {
    diagnostics.error({}, "number of threads is " + std::to_string(options.threads),
                      "0 (one per hardware thread) to " + std::to_string(kMaxThreads));
  }
  const AccelKind accel = choose_accel(accelerator_for(scene, options), scene.tables().tables,
                                       kernels != nullptr ? kernels->lanes : 1, diagnostics);
  if (diagnostics.has_errors()) return nullptr;
  return std::make_unique<RenderSession>(scene, options, *kernels, accel);
}

}  // namespace norrsken
