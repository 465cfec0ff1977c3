#include "render/worker_pool.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <system_error>
#include <thread>
#include <utility>

namespace norrsken {
namespace {

using std::chrono::milliseconds;

/// Waves of scenes with many shadow rays per hit are made smaller, so that stopping never takes long.
std::uint32_t slots_per_wave(const IntegratorSettings& integrator) {
  constexpr std::uint32_t kManyRays = 256;
  const auto rays = static_cast<std::uint32_t>(integrator.emitter_samples);
  return std::clamp(kWaveSlots / std::max(rays / kManyRays, 1u), kMaxLanes, kWaveSlots);
}

/// Threads that are waited for, whatever happens: leaving early tells them to stop and joins them.
class JoiningThreads {
 public:
  explicit JoiningThreads(std::atomic<bool>& stop) : stop_(stop) {}
  JoiningThreads(const JoiningThreads&) = delete;
  JoiningThreads& operator=(const JoiningThreads&) = delete;
  ~JoiningThreads() {
    stop_.store(true, std::memory_order_relaxed);
    for (std::thread& thread : threads_) thread.join();
    stop_.store(false, std::memory_order_relaxed);
  }

  /// False if the system gives no more threads; those that run do the work of all.
  template <class Body>
  bool start(Body body) {
    const std::lock_guard lock(mutex_);
    threads_.reserve(threads_.size() + 1);
    try {
      threads_.emplace_back([this, body] {
        body();
        const std::lock_guard done(mutex_);
        --working_;
        all_done_.notify_all();
      });
    } catch (const std::system_error&) {
      return false;
    }
    ++working_;
    return true;
  }

  int size() const { return static_cast<int>(threads_.size()); }

  /// True when all are done, false when the time is over.
  bool wait_for(milliseconds time) {
    std::unique_lock lock(mutex_);
    return all_done_.wait_for(lock, time, [&] { return working_ == 0; });
  }

 private:
  std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::condition_variable all_done_;
  int working_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace

int worker_count(int asked) {
  if (asked > 0) return asked;
  return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

bool Work::features_done() const {
  return std::ranges::all_of(feature_progress, [&](std::uint32_t done) { return done == feature_samples.count(); });
}

void Work::set_goal(SampleGoal next) {
  goal = std::move(next);
  samples.end = samples.first + goal.most();
}

bool Work::done() const {
  return features_done() && std::ranges::equal(progress, goal.of_tile, std::ranges::greater_equal());
}

bool Work::has_first_samples() const { return std::ranges::find(progress, 0u) == progress.end(); }

std::uint64_t Work::samples_done() const {
  std::uint64_t done = 0;
  for (std::size_t tile = 0; tile < progress.size(); ++tile) done += progress[tile] * grid.pixels_of(tile);
  return done;
}

/// An area's samples go to the film block by block. Waves are handed out in order, so the wave that an area waits for is
/// always under way, and waiting for it cannot lock up. Paths from the lights land anywhere: for them the film is one
/// area, and every wave a block of it.
struct WorkerPool::Area {
  std::mutex mutex;  // the film's pixels of this area, its tiles' progress, and `next_block`
  std::condition_variable turn;
  std::uint64_t next_block = 0;
  std::uint64_t blocks_before = 0;  ///< those on the film when the pass began
  FilmRegion region;
  // Of paths from the lights, whose waves come to the film in parts: a part of one is there; and who wants to look waits for
  // the rest of it, and then the next one for him.
  bool in_wave = false;
  int looking = 0;
};

WorkerPool::WorkerPool(const SceneView& scene, const KernelEntry& kernels, Film& film, Work& work, int threads,
                       const std::atomic<bool>& cancelled)
    : scene_(scene),
      feature_scene_(scene),
      kernels_(kernels),
      film_(film),
      film_view_(film.view()),
      work_(work),
      threads_(threads),
      cancelled_(cancelled),
      samples_done_(work.samples_done()) {
  feature_scene_.features = film_view_.feature_mask;
  feature_scene_.needs_uv = scene.needs_uv || (film_view_.feature_mask & (kUvFeatures | kNormalFeatures)) != 0;
}

WorkerPool::~WorkerPool() = default;

TileGrid WorkerPool::grid(const SceneView& scene, std::uint32_t width, std::uint32_t height) {
  return TileGrid(width, height, slots_per_wave(scene.integrator));
}

bool WorkerPool::run_features(const Tick& tick) {
  const TileProgress& progress = work_.feature_progress;
  const WorkPlan::Cut cut = cut_for(work_.grid, work_.feature_samples, progress, progress);
  return run_passes(Pass::features, plan_passes(work_.grid, work_.feature_samples, cut), tick);
}

bool WorkerPool::run(const Tick& tick) {
  const Pass pass = scene_.integrator.from_lights ? Pass::particles : Pass::radiance;
  const WorkPlan::Cut cut = cut_for(work_.grid, work_.samples, work_.goal.of_tile, work_.progress);
  return run_passes(pass, plan_passes(work_.grid, work_.samples, cut), tick);
}

bool WorkerPool::run_passes(Pass pass, const std::vector<WorkPlan>& plans, const Tick& tick) {
  for (const WorkPlan& plan : plans) {
    const End end = run_pass(pass, plan, tick);
    if (end != End::whole) return end != End::no_threads;
    if (!tick.call()) return true;
  }
  return true;
}

void WorkerPool::start_areas(Pass pass, const WorkPlan& plan) {
  areas_wanted_ = true;
  const std::lock_guard lock(areas_mutex_);
  areas_wanted_ = false;
  ++areas_generation_;
  const TileProgress& progress = pass == Pass::features ? work_.feature_progress : work_.progress;
  area_count_ = pass == Pass::particles ? 1 : plan.area_count();
  areas_ = std::make_unique<Area[]>(area_count_);
  std::uint64_t least = plan.wave_count() / plan.area_count();
  for (std::uint64_t i = 0; i < plan.area_count(); ++i) {
    const std::uint64_t blocks = plan.blocks_done(plan.progress_of(i, progress));
    least = std::min(least, blocks);
    if (pass == Pass::particles) continue;
    const WaveJob job = plan.wave(i);
    areas_[i].region = {job.x0, job.y0, job.width, job.height};
    areas_[i].next_block = areas_[i].blocks_before = blocks;
  }
  first_wave_ = least * plan.area_count();
  if (pass != Pass::particles) return;
  areas_[0].region = {0, 0, film_.width(), film_.height()};
  areas_[0].next_block = first_wave_;
}

WorkerPool::End WorkerPool::run_pass(Pass pass, const WorkPlan& plan, const Tick& tick) {
  start_areas(pass, plan);
  const std::uint64_t waves = plan.wave_count() - first_wave_;
  if (waves == 0) return End::whole;
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(static_cast<std::uint64_t>(threads_), waves));
  // All memory before the first thread: what runs in the threads cannot fail.
  arenas_.reserve(wanted);
  while (arenas_.size() < wanted) arenas_.emplace_back(kWaveSlots, WaveNeeds::of(scene_.integrator));
  std::atomic<std::uint64_t> next_wave{first_wave_};
  JoiningThreads threads(stop_);
  for (std::size_t i = 0; i < wanted; ++i) {
    WaveMemory& memory = arenas_[i].memory();
    if (!threads.start([this, pass, &plan, &next_wave, &memory] { work(pass, plan, next_wave, memory); })) break;
  }
  if (threads.size() == 0) return End::no_threads;
  threads_used_ = std::max(threads_used_, threads.size());
  while (!threads.wait_for(tick.interval)) {
    if (!tick.call()) return End::stopped;  // the destructor of `threads` stops them
  }
  return cancelled_.load(std::memory_order_relaxed) ? End::stopped : End::whole;
}

void WorkerPool::work(Pass pass, const WorkPlan& plan, std::atomic<std::uint64_t>& next_wave, WaveMemory& memory) {
  const TileProgress& progress = pass == Pass::radiance ? work_.progress : work_.feature_progress;
  constexpr std::uint32_t kAll = std::numeric_limits<std::uint32_t>::max() / 2;
  WaveCounts counts;
  while (!cancelled_.load(std::memory_order_relaxed) && !stop_.load(std::memory_order_relaxed)) {
    const std::uint64_t wave = next_wave.fetch_add(1, std::memory_order_relaxed);
    if (wave >= plan.wave_count()) break;
    const std::uint64_t area = plan.area_of(wave);
    WaveJob job = plan.wave(wave);
    if (pass == Pass::particles) {
      trace_particles(plan, wave, job, memory, counts);
      continue;
    }
    const Area& on_film = areas_[area];
    if (plan.block_of(wave) < on_film.blocks_before) continue;
    // Only an area's first wave finds a part of its samples on the film. It alone changes the progress until it is there.
    const std::uint32_t done = plan.block_of(wave) == on_film.blocks_before ? plan.progress_of(area, progress) : 0;
    job = plan.remaining(job, done, pass == Pass::radiance ? plan.progress_of(area, work_.goal.of_tile) : kAll);
    // An area that has all its samples needs none of the later blocks either.
    if (job.sample_count == 0) continue;
    if (pass == Pass::radiance) {
      kernels_.trace_wave(scene_, job, memory, counts);
    } else {
      kernels_.trace_features(feature_scene_, job, memory, counts);
    }
    add_to_film(pass, plan, wave, job, memory);
  }
  const std::lock_guard lock(mutex_);
  counts_.closest_rays += counts.closest_rays;
  counts_.shadow_rays += counts.shadow_rays;
  counts_.wrong_media += counts.wrong_media;
  counts_.wrong_medium_shape = std::min(counts_.wrong_medium_shape, counts.wrong_medium_shape);
}

void WorkerPool::add_to_film(Pass pass, const WorkPlan& plan, std::uint64_t wave, const WaveJob& job,
                             WaveMemory& memory) {
  Area& area = areas_[plan.area_of(wave)];
  DroppedSamples dropped;
  {
    std::unique_lock lock(area.mutex);
    area.turn.wait(lock, [&] { return area.next_block == plan.block_of(wave); });
    if (pass == Pass::radiance) {
      kernels_.accumulate_film(job, scene_.sampler.kind, memory.slots, film_view_, dropped);
    } else {
      kernels_.accumulate_features(job, memory.slots, film_view_);
    }
    plan.set_progress_of(plan.area_of(wave), plan.end_of(job),
                         pass == Pass::radiance ? work_.progress : work_.feature_progress);
    ++area.next_block;
    area.turn.notify_all();
  }
  if (pass == Pass::radiance) count_samples(job, dropped);
}

void WorkerPool::trace_particles(const WorkPlan& plan, std::uint64_t wave, const WaveJob& whole, WaveMemory& memory,
                                 WaveCounts& counts) {
  Area& film = areas_[0];
  // An area's waves may be under way side by side, but only its first may have a part of its samples on the film.
  WaveJob job = whole;
  {
    const std::lock_guard lock(film.mutex);
    const std::uint64_t area = plan.area_of(wave);
    job = plan.remaining(whole, plan.progress_of(area, work_.progress), plan.progress_of(area, work_.goal.of_tile));
  }
  DroppedSamples dropped;
  for (std::uint32_t hit_number = 1; hit_number != 0;) {
    const bool is_done = job.sample_count == 0;
    hit_number = is_done ? 0 : kernels_.trace_particles(scene_, job, hit_number, memory, counts);
    std::unique_lock lock(film.mutex);
    film.turn.wait(lock, [&] { return film.next_block == wave && (film.in_wave || film.looking == 0); });
    film.in_wave = hit_number != 0;
    if (!is_done) film_.splats().add(job, memory.splats, dropped);
    if (hit_number != 0) continue;
    if (!is_done) {
      kernels_.accumulate_film(job, scene_.sampler.kind, memory.slots, film_view_, dropped);
      film_.splats().count_paths(job);
      plan.set_progress_of(plan.area_of(wave), plan.end_of(job), work_.progress);
    }
    ++film.next_block;
    film.turn.notify_all();
  }
  count_samples(job, dropped);
}

void WorkerPool::count_samples(const WaveJob& job, const DroppedSamples& dropped) {
  samples_done_.fetch_add(std::uint64_t{job.pixel_count()} * job.sample_count, std::memory_order_relaxed);
  if (dropped.count == 0) return;
  const std::lock_guard lock(mutex_);
  work_.dropped.add(dropped);
}

void WorkerPool::look_at_area(Area& area, const FilmRegion& part, const std::function<void(const FilmRegion&)>& look) {
  // Large areas row by row, so that whoever wants to write there gets in between.
  constexpr std::uint32_t kPixelsAtOnce = 1u << 14;
  const std::uint32_t rows = std::max(kPixelsAtOnce / std::max(part.width, 1u), 1u);
  for (std::uint32_t y = 0; y < part.height; y += rows) {
    std::unique_lock lock(area.mutex);
    ++area.looking;
    area.turn.wait(lock, [&] { return !area.in_wave; });
    look({part.x0, part.y0 + y, part.width, std::min(rows, part.height - y)});
    --area.looking;
    area.turn.notify_all();
  }
}

void WorkerPool::look_at(const FilmRegion& region, const std::function<void(const FilmRegion&)>& look) {
  // A new pass divides the film anew: then it is looked at from the start. Where that goes on, the pass waits.
  constexpr int kMostAttempts = 4;
  for (int attempt = 1;; ++attempt) {
    std::unique_lock lock(areas_mutex_);
    if (area_count_ == 0) return look(region);
    const std::uint64_t generation = areas_generation_;
    for (std::uint64_t i = 0; i < area_count_ && generation == areas_generation_; ++i) {
      const FilmRegion part = intersection(areas_[i].region, region);
      if (part.width == 0 || part.height == 0) continue;
      look_at_area(areas_[i], part, look);
      if (attempt == kMostAttempts) continue;
      lock.unlock();
      while (areas_wanted_) std::this_thread::yield();
      lock.lock();
    }
    if (generation == areas_generation_) return;
  }
}

std::uint32_t WorkerPool::least_samples() {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  const auto look = [&](const FilmRegion& part) {
    work_.grid.for_each_tile(part, [&](std::uint64_t tile) { least = std::min(least, work_.progress[tile]); });
  };
  look_at({0, 0, film_.width(), film_.height()}, look);
  return least;
}

RelativeError WorkerPool::relative_error() {
  // Looking costs a pass over the film, so it is done once a second, and only while it would tell something new.
  const std::uint64_t samples = samples_done();
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ < std::chrono::seconds(1) || samples < last_error_samples_ + last_error_samples_ / 16 + 1) {
    // Meanwhile it falls with the root of the samples.
    RelativeError error = last_error_;
    if (error.value > 0) {
      const double factor = std::sqrt(static_cast<double>(last_error_samples_) / static_cast<double>(samples));
      error.value *= factor, error.low *= factor, error.high *= factor;
    }
    return error;
  }
  last_look_ = now;
  last_error_samples_ = samples;
  FilmError total;
  for (std::uint64_t i = 0; i < area_count_; ++i) {
    const std::lock_guard lock(areas_[i].mutex);
    total += film_.error(areas_[i].region);
  }
  return last_error_ = total.relative();
}

RenderStatistics WorkerPool::statistics() const {
  const std::lock_guard lock(mutex_);
  RenderStatistics s;
  s.samples = samples_done();
  s.threads = threads_used_;
  s.closest_rays = counts_.closest_rays;
  s.shadow_rays = counts_.shadow_rays;
  const DroppedSamples& dropped = work_.dropped;
  s.dropped_samples = dropped.count;
  s.wrong_media = counts_.wrong_media;
  if (counts_.wrong_media > 0) s.wrong_medium_shape = static_cast<int>(counts_.wrong_medium_shape);
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(dropped.count, DroppedSamples::kKept); ++i) {
    s.dropped.push_back({static_cast<int>(dropped.pixel[i] % film_.width()),
                         static_cast<int>(dropped.pixel[i] / film_.width()), dropped.sample[i]});
  }
  return s;
}

}  // namespace norrsken
