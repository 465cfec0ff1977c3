#include "norrsken/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "compile/compile.h"
#include "film/section_file.h"
#include "isa/entry.h"
#include "render/checkpoint.h"
#include "render/crew.h"
#include "render/frame_memory.h"
#include "render/scene_view.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kFeatureSamples = 16;
constexpr double kProgressSeconds = 0.1;
constexpr std::uint32_t kMostSamples = std::numeric_limits<int>::max();

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

FilmSettings film_settings(const SceneTables& tables) {
  FilmSettings film = tables.film;
  film.opaque = tables.environment != kNone && !tables.integrator.hide_emitters;
  return film;
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

SampleRange sample_range(const SceneTables& tables, const RenderOptions& options) {
  if (options.samples) return *options.samples;
  const auto count = options.samples_per_pixel.value_or(static_cast<int>(tables.sampler.samples_per_pixel));
  return {0, static_cast<std::uint32_t>(count)};
}

/// Planes hold polygons, which do not know the triangles that they were merged from.
std::string accelerator_for(const Scene& scene, const RenderOptions& options) {
  const bool counts_triangles = std::ranges::any_of(
      scene.tables().layers.features, [](const FeatureLayer& layer) { return layer.feature == kFeaturePrimitive; });
  return counts_triangles && options.accelerator == "auto" ? "embree" : options.accelerator;
}

/// Scenes that name layers get them of as many samples as the image, others of the first few of all.
SampleRange feature_range(const Scene& scene, const RenderOptions& options, SampleRange samples) {
  if (needs_all_features(scene)) return samples;
  if (!options.features) return {};
  return {std::min(samples.first, kFeatureSamples), std::min(samples.end, kFeatureSamples)};
}

Work make_work(const SceneView& view, const Film& film, SampleRange samples, SampleRange feature_samples) {
  const TileGrid grid = Crew::grid(view, film.width(), film.height());
  const TileProgress none(grid.tile_count());
  return {grid, samples, feature_samples, none, feature_samples.count() > 0 ? none : TileProgress{}, {}};
}

class RenderSession final : public Render {
 public:
  RenderSession(Scene scene, const RenderOptions& options, const KernelEntry& kernels, MemoryReservation frame,
                std::unique_ptr<const Accel> accel)
      : scene_(std::move(scene)),
        tables_(scene_.tables().tables),
        kernels_(kernels),
        frame_(std::move(frame)),
        accel_(std::move(accel)),
        view_(make_scene_view(tables_, accel_->view())),
        threads_(crew_size(options.threads)),
        film_(film_settings(tables_), view_.sampler.kind, layers(scene_, options)),
        work_(make_work(view_, film_, sample_range(tables_, options),
                        feature_range(scene_, options, sample_range(tables_, options)))) {
    view_.sampler.seed += options.seed;
    film_.set_samples(SampleSet({work_.samples}));
    if (view_.integrator.from_lights) film_.add_splats(Splats(view_.film, tables_.filter));
    checkpoint_ = options.checkpoint;
    checkpoint_seconds_ = options.checkpoint_seconds;
    if (checkpoint_.empty()) return;
    form_ = {film_settings(tables_), view_.sampler.kind, view_.integrator.from_lights, layers(scene_, options)};
    traits_ = traits_of(tables_, view_, form_.settings, form_.layers, kernels_.name, accel_name(view_.accel.kind));
  }

  /// Takes up what the checkpoint holds.
  void resume(Diagnostics& diagnostics) {
    const Resumption resumption = resume_render(checkpoint_, traits_, work_, film_, diagnostics);
    // What is damaged must not take the place of what is not.
    older_ = resumption == Resumption::older ? OlderGeneration::replace : OlderGeneration::keep;
  }

  RenderStatistics run(const std::function<void(const RenderProgress&)>& on_progress) override {
    Crew crew(view_, kernels_, film_, work_, threads_, cancelled_);
    const std::uint64_t total = std::uint64_t{work_.samples.count()} * film_.width() * film_.height();
    const std::uint64_t resumed = crew.samples_done();
    Stopwatch watch, since_progress;
    const auto progress = [&] {
      RenderProgress p;
      p.samples_done = crew.samples_done();
      p.samples_total = total;
      p.samples_resumed = resumed;
      p.elapsed_seconds = watch.seconds();
      p.samples_per_second = static_cast<double>(p.samples_done - resumed) / std::max(p.elapsed_seconds, 1e-9);
      p.relative_error = crew.relative_error();
      p.checkpoint_error = checkpoint_error_;
      return p;
    };
    while (!work_.done() && !cancelled_.load(std::memory_order_relaxed)) {
      const Stopwatch since_save;
      const Crew::Tick tick{tick_interval(), [&] {
                              if (on_progress && since_progress.seconds() >= kProgressSeconds) {
                                since_progress = {};
                                on_progress(progress());
                              }
                              return checkpoint_.empty() || since_save.seconds() < checkpoint_seconds_;
                            }};
      if (!work_.features_done()) {
        crew.run_features(tick);
        watch = {};  // figures are those of the image, not of its layers
      }
      if (work_.features_done()) crew.run(tick);
      save();
    }

    RenderStatistics s = crew.statistics();
    s.samples_resumed = resumed;
    s.seconds = watch.seconds();
    s.cancelled = !work_.done();
    s.has_image = s.samples > 0 && work_.features_done();
    s.checkpoint_error = checkpoint_error_;
    s.relative_error = film_.error({0, 0, film_.width(), film_.height()}).relative();
    s.isa = kernels_.name;
    s.lanes = static_cast<int>(kernels_.lanes);
    s.samples_of_pixels = !view_.integrator.from_lights;
    s.accelerator = accel_name(view_.accel.kind);
    if (on_progress) {
      RenderProgress last = progress();
      last.elapsed_seconds = s.seconds;
      last.relative_error = s.relative_error;
      on_progress(last);
    }
    return s;
  }

  void cancel() noexcept override { cancelled_.store(true, std::memory_order_relaxed); }

  Image image(bool statistics) const override { return film_.image(statistics, work_.feature_samples.count()); }

 private:
  /// Short where checkpoints are written more often than progress is told.
  std::chrono::milliseconds tick_interval() const {
    const double seconds = checkpoint_.empty() ? kProgressSeconds : std::min(kProgressSeconds, checkpoint_seconds_);
    return std::chrono::milliseconds(std::max(static_cast<int>(seconds * 1000), 1));
  }

  void save() {
    if (checkpoint_.empty()) return;
    checkpoint_error_ = save_render(checkpoint_, traits_, form_, work_, film_, older_).error;
    if (checkpoint_error_.empty()) older_ = OlderGeneration::keep;
  }

  Scene scene_;
  const SceneTables& tables_;
  const KernelEntry& kernels_;
  MemoryReservation frame_;  ///< of film, image and threads
  std::unique_ptr<const Accel> accel_;
  SceneView view_;
  int threads_;
  Film film_;
  Work work_;
  std::string checkpoint_;
  double checkpoint_seconds_ = 0;
  Traits traits_;  ///< this and the next for checkpoints only
  FilmForm form_;
  OlderGeneration older_ = OlderGeneration::keep;
  std::string checkpoint_error_;
  std::atomic<bool> cancelled_{false};
};

}  // namespace

IoStatus check_checkpoint_writable(const std::string& path) { return check_sections_writable(path); }

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
  if (options.samples && options.samples->first >= options.samples->end) {
    diagnostics.error({}, fmt::format("samples {} to {}", options.samples->first, options.samples->end),
                      "a first sample, and a greater one behind the last");
  }
  if (options.samples && options.samples->end > kMostSamples) {
    diagnostics.error({}, fmt::format("samples end at {}", options.samples->end),
                      fmt::format("up to {}", kMostSamples));
  }
  if (diagnostics.has_errors()) return nullptr;
  auto frame = reserve_frame(scene.tables(), film_settings(scene.tables().tables), layers(scene, options),
                             crew_size(options.threads), diagnostics);
  auto built = frame ? build_accel(scene.tables(), accel, diagnostics) : nullptr;
  if (!built) return nullptr;
  auto session = std::make_unique<RenderSession>(scene, options, *kernels, std::move(*frame), std::move(built));
  if (!options.checkpoint.empty()) session->resume(diagnostics);
  if (diagnostics.has_errors()) return nullptr;
  return session;
}

}  // namespace norrsken
