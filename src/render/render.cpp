#include "norrsken/render.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include "compile/compile.h"
#include "film/film_image.h"
#include "film/section_file.h"
#include "isa/entry.h"
#include "render/checkpoint_file.h"
#include "render/frame_memory.h"
#include "render/provenance.h"
#include "render/request.h"
#include "render/scene_state.h"
#include "render/scene_view.h"
#include "render/worker_pool.h"
#include "scene/within_memory.h"

namespace norrsken {
namespace {

constexpr double kProgressSeconds = 0.1;

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

Work make_work(const SceneView& view, const Film& film, const SampleSchedule& schedule, SampleRange samples,
               SampleRange feature_samples) {
  const TileGrid grid = WorkerPool::grid(view, film.width(), film.height());
  const TileProgress none(grid.tile_count());
  Work work{grid, samples, feature_samples, {}, none, feature_samples.count() > 0 ? none : TileProgress{}, {}};
  work.set_goal(schedule.first(grid));
  return work;
}

/// Tells when every pixel has more than before.
class PassNotifier {
 public:
  PassNotifier(std::function<void(const RenderPass&)> notify, WorkerPool& workers,
               const std::atomic<bool>& has_features)
      : notify_(std::move(notify)), workers_(workers), has_features_(has_features), last_{0, has_features} {}

  void look() {
    if (!notify_) return;
    const RenderPass now{workers_.least_samples(), has_features_};
    if (now.samples <= last_.samples && now.has_layers == last_.has_layers) return;
    last_ = now;
    notify_(now);
  }

 private:
  std::function<void(const RenderPass&)> notify_;
  WorkerPool& workers_;
  const std::atomic<bool>& has_features_;
  RenderPass last_;
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
        threads_(worker_count(options.threads)),
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
    WorkerPool& workers = start_workers();
    const std::uint64_t resumed = workers.samples_done();
    Stopwatch watch;
    const auto progress = [&] { return progress_of(workers, resumed, watch.seconds()); };
    const auto notify = [&] {
      if (on_progress) on_progress(progress());
    };
    PassNotifier passes(callbacks.on_pass, workers, has_features_);
    bool is_complete = false;
    while (!is_complete && failure_.empty() && !cancelled_.load(std::memory_order_relaxed)) {
      reach_goal(workers, watch, notify, passes);
      const double seconds = watch.seconds();
      is_complete = has_features_ && work_.has_first_samples() && schedule_.is_over(seconds);
      if (!work_.done() || is_complete) continue;
      const double taken = static_cast<double>(workers.samples_done() - resumed) / pixels();
      std::optional<SampleGoal> next = schedule_.next(work_.grid, film_, work_.goal, seconds, taken);
      is_complete = !next;
      if (next) work_.set_goal(*std::move(next));
    }

    RenderStatistics s = workers.statistics();
    const std::vector<std::string>& ids = scene_.tables().shape_ids;
    const auto wrong = static_cast<std::size_t>(s.wrong_medium_shape);
    if (s.wrong_media > 0 && wrong < ids.size()) s.wrong_medium_shape_id = ids[wrong];
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
    end_workers(metadata_of(
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
      const std::lock_guard lock(workers_mutex_);
      if (workers_) {
        workers_->look_at(image.needed(), [&](const FilmRegion& part) { image.take(part); });
      } else {
        image.take(image.needed());
      }
      metadata = workers_ ? metadata_so_far() : metadata_;
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

  WorkerPool& start_workers() {
    const std::lock_guard lock(workers_mutex_);
    workers_ = std::make_unique<WorkerPool>(view_, kernels_, film_, work_, threads_, cancelled_);
    return *workers_;
  }
  /// From then on nobody writes to the film.
  void end_workers(Metadata metadata) {
    const std::lock_guard lock(workers_mutex_);
    workers_.reset();
    metadata_ = std::move(metadata);
  }

  /// Of an image that is taken while it is rendered.
  Metadata metadata_so_far() const {
    const double samples = static_cast<double>(workers_->samples_done()) / pixels();
    return metadata_of({made_.settings, seconds_now_}, {samples, ranges_, {}, 0, true});
  }

  /// Until the goal is reached, the rendering is cancelled or time is up. `notify` is called now and then.
  void reach_goal(WorkerPool& workers, Stopwatch& watch, const std::function<void()>& notify, PassNotifier& passes) {
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
      const WorkerPool::Tick tick{tick_interval(), [&] {
                                    const Temporarily looking(is_sampling_, false);
                                    if (since_progress.seconds() >= kProgressSeconds) {
                                      since_progress = {};
                                      notify();
                                    }
                                    passes.look();
                                    seconds_now_ = seconds_before_ + watch.seconds();
                                    return goes_on() && (!checkpoint_ || since_save.seconds() < checkpoint_seconds_);
                                  }};
      if (!has_features_) {
        const Temporarily sampling(is_sampling_, true);
        if (!workers.run_features(tick)) return fail();
        has_features_ = work_.features_done();
        watch = {};  // figures, and the time that there is, are those of the image, not of its layers
      }
      if (has_features_) {
        const Temporarily sampling(is_sampling_, true);
        if (!workers.run(tick)) return fail();
      }
      made_.seconds = seconds_before_ + watch.seconds();
      save();
    }
  }

  void fail() { failure_ = "the system starts no more threads"; }

  RenderProgress progress_of(WorkerPool& workers, std::uint64_t resumed, double seconds) const {
    RenderProgress p;
    p.samples_done = workers.samples_done();
    p.samples_total = work_.goal.total(work_.grid);
    p.samples_resumed = resumed;
    p.elapsed_seconds = seconds;
    const double taken = static_cast<double>(p.samples_done - resumed);
    p.samples_per_second = taken / std::max(seconds, 1e-9);
    p.error = workers.relative_error();
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
  mutable std::mutex workers_mutex_;     ///< for what follows, of the threads that look
  std::unique_ptr<WorkerPool> workers_;  ///< while there is one at work
  Metadata metadata_;
  std::atomic<bool> cancelled_{false}, is_sampling_{false};
};

}  // namespace

IoStatus check_checkpoint_writable(const std::string& path) { return check_sections_writable(path); }

std::vector<std::string> checkpoint_files(const std::string& path) { return files_of_sections(path); }

Result<std::unique_ptr<Render>> Render::create(const Scene& scene, const RenderOptions& options) {
  Diagnostics diagnostics(options.log);
  const KernelEntry* kernels = choose_kernels(options.isa, diagnostics);
  check_options(scene, options, diagnostics);
  const AccelKind accel = choose_accel(options.accelerator, scene.tables().tables, scene.frame().layers,
                                       kernels != nullptr ? kernels->lanes : 1, diagnostics);
  if (diagnostics.has_errors()) return diagnostics;
  auto memory = reserve_frame(scene.tables(), scene.frame(), film_settings(scene), layers(scene, options),
                              worker_count(options.threads), diagnostics);
  auto built =
      memory ? scene.state().accel(accel, scene.frame().layers, worker_count(options.threads), diagnostics) : nullptr;
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
