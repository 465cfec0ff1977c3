#include "render/crew.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "render/wave_arena.h"

namespace norrsken {
namespace {

using std::chrono::milliseconds;

/// Waves of scenes with many shadow rays per hit are made smaller, so that stopping never takes long.
std::uint32_t slots_per_wave(const IntegratorSettings& integrator) {
  const auto rays = static_cast<std::uint32_t>(integrator.emitter_samples);
  return std::clamp(kWaveSlots / std::max(rays / 64, 1u), 16 * kMaxLanes, kWaveSlots);
}

}  // namespace

int crew_size(int asked) {
  if (asked > 0) return asked;
  return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

/// A tile's samples go to the film block by block. Waves are handed out in order, so the wave that a tile waits for is
/// always under way, and waiting for it cannot lock up.
struct Crew::Tile {
  std::mutex mutex;  // the film's pixels of this tile, and what follows
  std::condition_variable turn;
  std::uint64_t next_block = 0;
  FilmRegion region;
};

Crew::Crew(const SceneView& scene, const KernelEntry& kernels, Film& film, int threads,
           const std::atomic<bool>& cancelled)
    : scene_(scene), kernels_(kernels), film_(film), film_view_(film.view()), threads_(threads), cancelled_(cancelled) {}

Crew::~Crew() = default;

void Crew::run_features(std::uint32_t samples) {
  run_pass(Pass::features, WorkPlan(film_.width(), film_.height(), samples, kWaveSlots), {});
}

void Crew::run(std::uint64_t samples, const std::function<void()>& tick) {
  const std::uint32_t slots = slots_per_wave(scene_.integrator);
  run_pass(Pass::radiance, WorkPlan(film_.width(), film_.height(), samples, slots), tick);
}

void Crew::run_pass(Pass pass, const WorkPlan& plan, const std::function<void()>& tick) {
  tile_count_ = plan.tile_count();
  tiles_ = std::make_unique<Tile[]>(tile_count_);
  for (std::uint64_t i = 0; i < tile_count_; ++i) {
    const WaveJob job = plan.wave(i);
    tiles_[i].region = {job.x0, job.y0, job.width, job.height};
  }

  std::atomic<std::uint64_t> next_wave{0};
  std::mutex done_mutex;
  std::condition_variable done;
  const auto threads = static_cast<int>(std::min<std::uint64_t>(static_cast<std::uint64_t>(threads_), plan.wave_count()));
  int working = threads;
  std::vector<std::thread> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) {
    workers.emplace_back([&] {
      try {
        work(pass, plan, next_wave);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
      }
      const std::lock_guard lock(done_mutex);
      --working;
      done.notify_all();
    });
  }
  {
    std::unique_lock lock(done_mutex);
    while (!done.wait_for(lock, milliseconds(100), [&] { return working == 0; })) {
      if (!tick) continue;
      lock.unlock();
      tick();
      lock.lock();
    }
  }
  for (std::thread& worker : workers) worker.join();
  if (failure_) std::rethrow_exception(failure_);
}

void Crew::work(Pass pass, const WorkPlan& plan, std::atomic<std::uint64_t>& next_wave) {
  WaveArena arena;
  WaveCounts counts;
  while (!cancelled_.load(std::memory_order_relaxed)) {
    const std::uint64_t wave = next_wave.fetch_add(1, std::memory_order_relaxed);
    if (wave >= plan.wave_count()) break;
    const WaveJob job = plan.wave(wave);
    const auto trace = pass == Pass::radiance ? kernels_.trace_wave : kernels_.trace_features;
    trace(scene_, job, arena.memory(), counts);
    add_to_film(pass, plan, wave, arena.memory());
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
  const std::uint64_t samples = samples_done();
  // Looking costs a pass over the film: once per sixteenth of growth keeps it far below the rendering itself.
  if (samples < last_error_samples_ + last_error_samples_ / 16 + 1) return last_error_;
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
