#include "render/crew.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "render/wave_arena.h"

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
class Gathering {
 public:
  explicit Gathering(std::atomic<bool>& stop) : stop_(stop) {}
  Gathering(const Gathering&) = delete;
  Gathering& operator=(const Gathering&) = delete;
  ~Gathering() {
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

int crew_size(int asked) {
  if (asked > 0) return asked;
  return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

/// A tile's samples go to the film block by block. Waves are handed out in order, so the wave that a tile waits for is
/// always under way, and waiting for it cannot lock up. Paths from the lights land anywhere: for them the film is one
/// tile, and every wave a block of it.
struct Crew::Tile {
  std::mutex mutex;  // the film's pixels of this tile, and what follows
  std::condition_variable turn;
  std::uint64_t next_block = 0;
  FilmRegion region;
};

Crew::Crew(const SceneView& scene, const KernelEntry& kernels, Film& film, int threads,
           const std::atomic<bool>& cancelled)
    : scene_(scene),
      feature_scene_(scene),
      kernels_(kernels),
      film_(film),
      film_view_(film.view()),
      threads_(threads),
      cancelled_(cancelled) {
  feature_scene_.features = film_view_.feature_mask;
  feature_scene_.needs_uv = scene.needs_uv || (film_view_.feature_mask & kUvFeatures) != 0;
}

Crew::~Crew() = default;

void Crew::run_features(std::uint32_t samples, const std::function<void()>& tick) {
  run_pass(Pass::features, WorkPlan(film_.width(), film_.height(), samples, kWaveSlots), tick);
}

void Crew::run(std::uint64_t samples, const std::function<void()>& tick) {
  const std::uint32_t slots = slots_per_wave(scene_.integrator);
  const Pass pass = scene_.integrator.from_lights ? Pass::particles : Pass::radiance;
  run_pass(pass, WorkPlan(film_.width(), film_.height(), samples, slots), tick);
}

void Crew::run_pass(Pass pass, const WorkPlan& plan, const std::function<void()>& tick) {
  tile_count_ = pass == Pass::particles ? 1 : plan.tile_count();
  tiles_ = std::make_unique<Tile[]>(tile_count_);
  for (std::uint64_t i = 0; i < tile_count_; ++i) {
    const WaveJob job = plan.wave(i);
    tiles_[i].region = {job.x0, job.y0, job.width, job.height};
  }
  if (pass == Pass::particles) tiles_[0].region = {0, 0, film_.width(), film_.height()};

  const auto wanted =
      static_cast<std::size_t>(std::min<std::uint64_t>(static_cast<std::uint64_t>(threads_), plan.wave_count()));
  // All memory before the first thread: what runs in the threads cannot fail.
  std::vector<WaveArena> arenas;
  arenas.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) arenas.emplace_back(kWaveSlots, pass == Pass::particles);
  std::atomic<std::uint64_t> next_wave{0};
  Gathering gathering(stop_);
  for (WaveArena& arena : arenas) {
    if (!gathering.start([this, pass, &plan, &next_wave, &arena] { work(pass, plan, next_wave, arena.memory()); }))
      break;
  }
  threads_used_ = gathering.size();
  if (threads_used_ == 0) throw std::runtime_error("the system starts no more threads");
  while (!gathering.wait_for(milliseconds(100))) {
    if (tick) tick();
  }
}

void Crew::work(Pass pass, const WorkPlan& plan, std::atomic<std::uint64_t>& next_wave, WaveMemory& memory) {
  WaveCounts counts;
  while (!cancelled_.load(std::memory_order_relaxed) && !stop_.load(std::memory_order_relaxed)) {
    const std::uint64_t wave = next_wave.fetch_add(1, std::memory_order_relaxed);
    if (wave >= plan.wave_count()) break;
    if (pass == Pass::particles) {
      trace_particles(plan, wave, memory, counts);
      continue;
    }
    const WaveJob job = plan.wave(wave);
    if (pass == Pass::radiance) {
      kernels_.trace_wave(scene_, job, memory, counts);
    } else {
      kernels_.trace_features(feature_scene_, job, memory, counts);
    }
    add_to_film(pass, plan, wave, memory);
  }
  const std::lock_guard lock(mutex_);
  counts_.closest_rays += counts.closest_rays;
  counts_.shadow_rays += counts.shadow_rays;
}

void Crew::add_to_film(Pass pass, const WorkPlan& plan, std::uint64_t wave, WaveMemory& memory) {
  const WaveJob job = plan.wave(wave);
  Tile& tile = tiles_[plan.tile_of(wave)];
  DroppedSamples dropped;
  {
    std::unique_lock lock(tile.mutex);
    tile.turn.wait(lock, [&] { return tile.next_block == plan.block_of(wave); });
    if (pass == Pass::radiance) {
      kernels_.accumulate_film(job, scene_.sampler.kind, memory.slots, film_view_, dropped);
    } else {
      kernels_.accumulate_features(job, memory.slots, film_view_);
    }
    ++tile.next_block;
    tile.turn.notify_all();
  }
  if (pass == Pass::features) return;
  samples_done_.fetch_add(std::uint64_t{job.pixel_count()} * job.sample_count, std::memory_order_relaxed);
  keep_dropped(dropped);
}

void Crew::trace_particles(const WorkPlan& plan, std::uint64_t wave, WaveMemory& memory, WaveCounts& counts) {
  const WaveJob job = plan.wave(wave);
  Tile& film = tiles_[0];
  DroppedSamples dropped;
  for (std::uint32_t hit_number = 1; hit_number != 0;) {
    hit_number = kernels_.trace_particles(scene_, job, hit_number, memory, counts);
    std::unique_lock lock(film.mutex);
    film.turn.wait(lock, [&] { return film.next_block == wave; });
    film_.splats().add(job, memory.splats, dropped);
    if (hit_number != 0) continue;
    kernels_.accumulate_film(job, scene_.sampler.kind, memory.slots, film_view_, dropped);
    film_.splats().count_paths(job);
    ++film.next_block;
    film.turn.notify_all();
  }
  samples_done_.fetch_add(std::uint64_t{job.pixel_count()} * job.sample_count, std::memory_order_relaxed);
  keep_dropped(dropped);
}

void Crew::keep_dropped(const DroppedSamples& dropped) {
  if (dropped.count == 0) return;
  const std::lock_guard lock(mutex_);
  for (std::uint64_t i = 0; i < dropped.count && i < DroppedSamples::kKept; ++i) {
    const std::uint64_t at = dropped_.count + i;
    if (at >= DroppedSamples::kKept) break;
    dropped_.pixel[at] = dropped.pixel[i];
    dropped_.sample[at] = dropped.sample[i];
  }
  dropped_.count += dropped.count;
}

double Crew::relative_error() {
  // Looking costs a pass over the film, so it is done once a second, and only while it would tell something new.
  const std::uint64_t samples = samples_done();
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ < std::chrono::seconds(1) || samples < last_error_samples_ + last_error_samples_ / 16 + 1) {
    return last_error_;
  }
  last_look_ = now;
  last_error_samples_ = samples;
  FilmError total;
  for (std::uint64_t i = 0; i < tile_count_; ++i) {
    const std::lock_guard lock(tiles_[i].mutex);
    total += film_.error(tiles_[i].region);
  }
  return last_error_ = total.relative();
}

RenderStatistics Crew::statistics() const {
  const std::lock_guard lock(mutex_);
  RenderStatistics s;
  s.samples = samples_done();
  s.threads = threads_used_;
  s.closest_rays = counts_.closest_rays;
  s.shadow_rays = counts_.shadow_rays;
  s.dropped_samples = dropped_.count;
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(dropped_.count, DroppedSamples::kKept); ++i) {
    s.dropped.push_back({static_cast<int>(dropped_.pixel[i] % film_.width()),
                         static_cast<int>(dropped_.pixel[i] / film_.width()), dropped_.sample[i]});
  }
  return s;
}

}  // namespace norrsken
