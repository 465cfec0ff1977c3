#include "norrsken/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "compile/compile.h"
#include "film/film_image.h"
#include "film/section_file.h"
#include "isa/entry.h"
#include "render/checkpoint_file.h"
#include "render/crew.h"
#include "render/frame_memory.h"
#include "render/provenance.h"
#include "render/scene_state.h"
#include "render/scene_view.h"
#include "scene/within_memory.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kFeatureSamples = 16;
/// Of scenes that name layers, where nobody knows how many samples the image will have.
constexpr std::uint32_t kOpenFeatureSamples = 64;
constexpr double kProgressSeconds = 0.1;
constexpr std::uint32_t kMostSamples = std::numeric_limits<int>::max();

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// While it lives, the flag has this value.
class Temporarily {
 public:
  Temporarily(std::atomic<bool>& flag, bool value) : flag_(flag), before_(flag.exchange(value)) {}
  ~Temporarily() { flag_.store(before_); }
  Temporarily(const Temporarily&) = delete;
  Temporarily& operator=(const Temporarily&) = delete;

 private:
  std::atomic<bool>& flag_;
  bool before_;
};

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

bool needs_all_features(const Scene& scene) {
  return !scene.frame().layers.features.empty() || scene.frame().film.has_alpha();
}

/// The samples that are asked for, by the scene if nobody else does.
SampleRange sample_range(const Scene& scene, const RenderOptions& options) {
  if (options.samples) return *options.samples;
  const auto count = options.samples_per_pixel.value_or(static_cast<int>(scene.frame().sampler.samples_per_pixel));
  return {0, static_cast<std::uint32_t>(count)};
}

/// Scenes that name layers get them of as many samples as the image, others of the first few of all.
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

Work make_work(const SceneView& view, const Film& film, const SampleSchedule& schedule, SampleRange samples,
               SampleRange feature_samples) {
  const TileGrid grid = Crew::grid(view, film.width(), film.height());
  const TileProgress none(grid.tile_count());
  Work work{grid, samples, feature_samples, {}, none, feature_samples.count() > 0 ? none : TileProgress{}, {}};
  work.set_goal(schedule.first(grid));
  return work;
}

/// Tells when every pixel has more than before.
class PassTeller {
 public:
  PassTeller(std::function<void(const RenderPass&)> tell, Crew& crew, const std::atomic<bool>& has_features)
      : tell_(std::move(tell)), crew_(crew), has_features_(has_features), told_{0, has_features} {}

  void look() {
    if (!tell_) return;
    const RenderPass now{crew_.least_samples(), has_features_};
    if (now.samples <= told_.samples && now.has_layers == told_.has_layers) return;
    told_ = now;
    tell_(now);
  }

 private:
  std::function<void(const RenderPass&)> tell_;
  Crew& crew_;
  const std::atomic<bool>& has_features_;
  RenderPass told_;
};

class RenderSession final : public Render {
 public:
  RenderSession(Scene scene, const RenderOptions& options, const KernelEntry& kernels, MemoryReservation frame,
                std::shared_ptr<const Accel> accel)
      : scene_(std::move(scene)),
        kernels_(kernels),
        memory_(std::move(frame)),
        accel_(std::move(accel)),
        view_(scene_.state().view(scene_.frame(), accel_->view())),
        threads_(crew_size(options.threads)),
        film_(film_settings(scene_), view_.sampler.kind, layers(scene_, options)),
        schedule_(make_schedule(sample_range(scene_, options), options)),
        work_(make_work(view_, film_, schedule_, sample_range(scene_, options),
                        feature_range(scene_, options, sample_range(scene_, options)))) {
    view_.sampler.seed += options.seed;
    film_.set_samples(SampleSet({{work_.samples.first, kMostSamples}}));
    if (view_.integrator.from_lights) film_.add_splats(Splats(view_.film, scene_.frame().filter));
    made_.settings = settings_of(scene_, options, kernels_.name, accel_name(view_.accel.kind));
    if (options.samples) ranges_ = {*options.samples};
    if (options.checkpoint.empty()) return;
    checkpoint_seconds_ = options.checkpoint_seconds;
    FilmForm form = {film_settings(scene_), view_.sampler.kind, view_.integrator.from_lights, layers(scene_, options)};
    Traits traits = traits_of(scene_.tables().tables, scene_.frame(), view_, form.settings, form.layers, kernels_.name,
                              accel_name(view_.accel.kind));
    checkpoint_.emplace(options.checkpoint, std::move(traits), std::move(form));
  }

  /// Takes up what the checkpoint holds, if there is to be one.
  void resume(Diagnostics& diagnostics) {
    if (checkpoint_) checkpoint_->resume(schedule_, work_, film_, seconds_before_, diagnostics);
    has_features_ = work_.features_done();
  }

  RenderStatistics run(const RenderCallbacks& callbacks) override {
    const auto& on_progress = callbacks.on_progress;
    Crew& crew = start_crew();
    const std::uint64_t resumed = crew.samples_done();
    Stopwatch watch;
    const auto progress = [&] { return progress_of(crew, resumed, watch.seconds()); };
    const auto tell = [&] {
      if (on_progress) on_progress(progress());
    };
    PassTeller passes(callbacks.on_pass, crew, has_features_);
    bool is_complete = false;
    while (!is_complete && failure_.empty() && !cancelled_.load(std::memory_order_relaxed)) {
      reach_goal(crew, watch, tell, passes);
      const double seconds = watch.seconds();
      is_complete = has_features_ && work_.has_first_samples() && schedule_.is_over(seconds);
      if (!work_.done() || is_complete) continue;
      const double taken = static_cast<double>(crew.samples_done() - resumed) / pixels();
      std::optional<SampleGoal> next = schedule_.next(work_.grid, film_, work_.goal, seconds, taken);
      is_complete = !next;
      if (next) work_.set_goal(*std::move(next));
    }

    RenderStatistics s = crew.statistics();
    s.samples_resumed = resumed;
    s.seconds = watch.seconds();
    s.failure = failure_;
    s.cancelled = !is_complete && failure_.empty();
    s.has_image = s.samples > 0 && work_.features_done();
    s.checkpoint_error = checkpoint_error_;
    s.error = film_.error({0, 0, film_.width(), film_.height()}).relative();
    s.isa = kernels_.name;
    s.lanes = static_cast<int>(kernels_.lanes);
    s.samples_of_pixels = !view_.integrator.from_lights;
    s.accelerator = accel_name(view_.accel.kind);
    // With a checkpoint it is what that says: whoever goes on from it has taken no less.
    if (!checkpoint_) made_.seconds = seconds_before_ + s.seconds;
    passes.look();
    RenderProgress last = progress();
    end_crew(metadata_of(
        made_, {static_cast<double>(s.samples) / pixels(), ranges_, s.error, s.dropped_samples, !is_complete}));
    if (on_progress) {
      last.elapsed_seconds = s.seconds;
      last.error = s.error;
      if (is_complete) last.fraction = 1, last.seconds_left = 0, last.samples_total = last.samples_done;
      on_progress(last);
    }
    return s;
  }

  void cancel() noexcept override { cancelled_.store(true, std::memory_order_relaxed); }
  bool is_sampling() const noexcept override { return is_sampling_.load(std::memory_order_relaxed); }

  Image image(bool statistics, const std::optional<ImageRegion>& region) const override {
    FilmImage image(film_, region_of(region), statistics, has_features_ ? work_.feature_samples.count() : 0);
    Metadata metadata;
    {
      const std::lock_guard lock(crew_mutex_);
      if (crew_) {
        crew_->look_at(image.needed(), [&](const FilmRegion& part) { image.take(part); });
      } else {
        image.take(image.needed());
      }
      metadata = crew_ ? metadata_so_far() : metadata_;
    }
    Image result = std::move(image).finish();
    result.metadata = std::move(metadata);
    return result;
  }

 private:
  /// Short where checkpoints are written more often than progress is told.
  std::chrono::milliseconds tick_interval() const {
    const double seconds = !checkpoint_ ? kProgressSeconds : std::min(kProgressSeconds, checkpoint_seconds_);
    return std::chrono::milliseconds(std::max(static_cast<int>(seconds * 1000), 1));
  }

  double pixels() const { return static_cast<double>(film_.width()) * film_.height(); }

  FilmRegion region_of(const std::optional<ImageRegion>& region) const {
    const auto width = static_cast<std::int64_t>(film_.width()), height = static_cast<std::int64_t>(film_.height());
    if (!region) return {0, 0, film_.width(), film_.height()};
    const std::int64_t x0 = std::clamp<std::int64_t>(region->x, 0, width),
                       y0 = std::clamp<std::int64_t>(region->y, 0, height),
                       x1 = std::clamp(std::int64_t{region->x} + region->width, x0, width),
                       y1 = std::clamp(std::int64_t{region->y} + region->height, y0, height);
    return {static_cast<std::uint32_t>(x0), static_cast<std::uint32_t>(y0), static_cast<std::uint32_t>(x1 - x0),
            static_cast<std::uint32_t>(y1 - y0)};
  }

  Crew& start_crew() {
    const std::lock_guard lock(crew_mutex_);
    crew_ = std::make_unique<Crew>(view_, kernels_, film_, work_, threads_, cancelled_);
    return *crew_;
  }
  /// From then on nobody writes to the film.
  void end_crew(Metadata metadata) {
    const std::lock_guard lock(crew_mutex_);
    crew_.reset();
    metadata_ = std::move(metadata);
  }

  /// Of an image that is taken while it is rendered.
  Metadata metadata_so_far() const {
    const double samples = static_cast<double>(crew_->samples_done()) / pixels();
    return metadata_of({made_.settings, seconds_now_}, {samples, ranges_, {}, 0, true});
  }

  /// Until the goal is reached, the rendering is cancelled or time is up. `tell` is called now and then.
  void reach_goal(Crew& crew, Stopwatch& watch, const std::function<void()>& tell, PassTeller& passes) {
    Stopwatch since_progress;
    has_features_ = work_.features_done();
    // Without a sample of every pixel there is no image to stop at.
    const bool heeds_time = work_.has_first_samples();
    const auto goes_on = [&] {
      const bool is_over = heeds_time && has_features_ && schedule_.is_over(watch.seconds());
      return !cancelled_.load(std::memory_order_relaxed) && !is_over;
    };
    while (!work_.done() && goes_on()) {
      const Stopwatch since_save;
      // Whoever looks at the film takes no samples, though its workers do.
      const Crew::Tick tick{tick_interval(), [&] {
                              const Temporarily looking(is_sampling_, false);
                              if (since_progress.seconds() >= kProgressSeconds) {
                                since_progress = {};
                                tell();
                              }
                              passes.look();
                              seconds_now_ = seconds_before_ + watch.seconds();
                              return goes_on() && (!checkpoint_ || since_save.seconds() < checkpoint_seconds_);
                            }};
      if (!has_features_) {
        const Temporarily sampling(is_sampling_, true);
        if (!crew.run_features(tick)) return give_up();
        has_features_ = work_.features_done();
        watch = {};  // figures, and the time that there is, are those of the image, not of its layers
      }
      if (has_features_) {
        const Temporarily sampling(is_sampling_, true);
        if (!crew.run(tick)) return give_up();
      }
      made_.seconds = seconds_before_ + watch.seconds();
      save();
    }
  }

  void give_up() { failure_ = "the system starts no more threads"; }

  RenderProgress progress_of(Crew& crew, std::uint64_t resumed, double seconds) const {
    RenderProgress p;
    p.samples_done = crew.samples_done();
    p.samples_total = work_.goal.total(work_.grid);
    p.samples_resumed = resumed;
    p.elapsed_seconds = seconds;
    const double taken = static_cast<double>(p.samples_done - resumed);
    p.samples_per_second = taken / std::max(seconds, 1e-9);
    p.error = crew.relative_error();
    const Outlook outlook = schedule_.outlook(has_features_ ? seconds : 0, p.error,
                                              static_cast<double>(p.samples_done) / pixels(), taken / pixels());
    p.fraction = std::min(outlook.fraction, 0.99);  // only the last report says that all is done
    p.seconds_left = outlook.seconds_left;
    p.checkpoint_error = checkpoint_error_;
    return p;
  }

  void save() {
    if (checkpoint_) checkpoint_error_ = checkpoint_->save(made_, work_, film_).error;
  }

  Scene scene_;
  const KernelEntry& kernels_;
  MemoryReservation memory_;  ///< of film, image and threads
  std::shared_ptr<const Accel> accel_;
  SceneView view_;
  int threads_;
  Film film_;
  SampleSchedule schedule_;
  Work work_;
  std::atomic<bool> has_features_{false};  ///< as far as the thread that runs knows
  std::string failure_;
  std::optional<CheckpointFile> checkpoint_;
  double checkpoint_seconds_ = 0;
  std::string checkpoint_error_;
  Provenance made_;
  double seconds_before_ = 0;           ///< that the checkpoint's samples took
  std::atomic<double> seconds_now_{0};  ///< that the samples took
  std::vector<SampleRange> ranges_;
  mutable std::mutex crew_mutex_;  ///< for what follows, of the threads that look
  std::unique_ptr<Crew> crew_;     ///< while there is one at work
  Metadata metadata_;
  std::atomic<bool> cancelled_{false}, is_sampling_{false};
};

}  // namespace

IoStatus check_checkpoint_writable(const std::string& path) { return check_sections_writable(path); }

std::vector<std::string> checkpoint_files(const std::string& path) { return files_of_sections(path); }

Result<std::unique_ptr<Render>> Render::create(const Scene& scene, const RenderOptions& options) {
  Diagnostics diagnostics(options.log);
  const KernelEntry* kernels = choose_kernels(options.isa, diagnostics);
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
  if (goes_by_steps(options) && options.samples) {
    diagnostics.error({}, "samples of a range are taken all",
                      "no range, or neither an error, nor a time, nor adaptivity");
  }
  if (options.adaptive && scene.frame().integrator.from_lights) {
    diagnostics.error({}, "adaptive sampling with paths that begin at the lights", "another integrator than ptracer");
  }
  // Planes hold polygons, which do not know the triangles that they were merged from.
  const bool counts_triangles = variation_of(scene.frame().layers) == Variation::by_triangle;
  const AccelKind accel = choose_accel(options.accelerator, scene.tables().tables,
                                       kernels != nullptr ? kernels->lanes : 1, counts_triangles, diagnostics);
  if (options.samples && options.samples->first >= options.samples->end) {
    diagnostics.error({}, fmt::format("samples {} to {}", options.samples->first, options.samples->end),
                      "a first sample, and a greater one behind the last");
  }
  if (options.samples && options.samples->end > kMostSamples) {
    diagnostics.error({}, fmt::format("samples end at {}", options.samples->end),
                      fmt::format("up to {}", kMostSamples));
  }
  if (diagnostics.has_errors()) return diagnostics;
  auto memory = reserve_frame(scene.tables(), scene.frame(), film_settings(scene), layers(scene, options),
                              crew_size(options.threads), diagnostics);
  auto built =
      memory ? scene.state().accel(accel, scene.frame().layers, crew_size(options.threads), diagnostics) : nullptr;
  if (!built) return diagnostics;
  std::unique_ptr<RenderSession> session;
  try {
    within_memory({}, "the rendering", diagnostics, [&] {
      session = std::make_unique<RenderSession>(scene, options, *kernels, std::move(*memory), std::move(built));
      session->resume(diagnostics);
    });
  } catch (const LoadingStopped&) {
    // It has been said why.
  }
  if (diagnostics.has_errors()) return diagnostics;
  return {std::move(session), std::move(diagnostics)};
}

}  // namespace norrsken
