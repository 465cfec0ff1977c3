// The workers of one render: threads that take waves, trace them and add them to the film in order.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "film/film.h"
#include "isa/entry.h"
#include "norrsken/render.h"
#include "render/sample_schedule.h"
#include "render/wave_arena.h"
#include "render/work_plan.h"

namespace norrsken {

/// Threads to use: the number asked for, or one per hardware thread for 0.
int worker_count(int asked);

/// What the workers are to render, and how far they have come.
struct Work {
  TileGrid grid;
  SampleRange samples, feature_samples;  ///< features of none if there are no features
  SampleGoal goal;                       ///< of those samples
  TileProgress progress, feature_progress;
  DroppedSamples dropped;

  /// Another goal; the samples become those that it needs.
  void set_goal(SampleGoal next);
  bool features_done() const;
  /// Features and goal.
  bool done() const;
  /// Of every pixel.
  bool has_first_samples() const;
  /// Camera samples on the film.
  std::uint64_t samples_done() const;
};

class WorkerPool {
 public:
  struct Tick {
    std::chrono::milliseconds interval;
    std::function<bool()> call;
  };

  /// Borrows everything. Setting `cancelled` makes `run` return when the waves under way are on the film.
  WorkerPool(const SceneView& scene, const KernelEntry& kernels, Film& film, Work& work, int threads,
             const std::atomic<bool>& cancelled);
  ~WorkerPool();

  /// The waves that scenes are cut into.
  static TileGrid grid(const SceneView& scene, std::uint32_t width, std::uint32_t height);

  /// Go on with the work: the features, or the image. They call `tick` from the calling thread once in each
  /// interval and after each pass, and return with what is on the film when the work is done, when it is cancelled, or
  /// when `tick` returns false; then they may be called again. False if the system has not one thread for them.
  bool run_features(const Tick& tick);
  bool run(const Tick& tick);

  /// Calls `look` with parts that make up the region, each while nobody writes to it and no pixel has a part of a sample.
  /// Any thread may look, at any time. Of the workers only one who wants to write to a part waits while it is looked at.
  void look_at(const FilmRegion& region, const std::function<void(const FilmRegion&)>& look);
  /// The fewest that any pixel has on the film; asked by the thread that runs.
  std::uint32_t least_samples();

  std::uint64_t samples_done() const { return samples_done_.load(std::memory_order_relaxed); }
  /// Of what is on the film, looked at about once a second; -1 while unknown.
  RelativeError relative_error();
  /// Rays are those of these workers, samples those on the film.
  RenderStatistics statistics() const;

 private:
  struct Area;
  enum class Pass { radiance, features, particles };

  enum class End { whole, stopped, no_threads };
  End run_pass(Pass pass, const WorkPlan& plan, const Tick& tick);
  bool run_passes(Pass pass, const std::vector<WorkPlan>& plans, const Tick& tick);
  void start_areas(Pass pass, const WorkPlan& plan);
  void look_at_area(Area& area, const FilmRegion& part, const std::function<void(const FilmRegion&)>& look);
  void work(Pass pass, const WorkPlan& plan, std::atomic<std::uint64_t>& next_wave, WaveMemory& memory);
  void add_to_film(Pass pass, const WorkPlan& plan, std::uint64_t wave, const WaveJob& job, WaveMemory& memory);
  void trace_particles(const WorkPlan& plan, std::uint64_t wave, const WaveJob& job, WaveMemory& memory,
                       WaveCounts& counts);
  void count_samples(const WaveJob& job, const DroppedSamples& dropped);

  const SceneView& scene_;
  SceneView feature_scene_;  ///< the same, with what features need
  const KernelEntry& kernels_;
  Film& film_;
  FilmView film_view_;
  Work& work_;
  int threads_;
  int threads_used_ = 0;
  const std::atomic<bool>& cancelled_;
  std::atomic<bool> stop_{false};  ///< set while leaving a pass before its end

  std::vector<WaveArena> arenas_;
  std::mutex areas_mutex_;  ///< of those who look, and of the running thread while it changes what follows
  std::atomic<bool> areas_wanted_{false};  ///< it waits for that
  std::uint64_t areas_generation_ = 0;
  std::unique_ptr<Area[]> areas_;
  std::uint64_t area_count_ = 0;
  std::uint64_t first_wave_ = 0;  ///< of the pass; those before are on the film
  std::atomic<std::uint64_t> samples_done_{0};

  mutable std::mutex mutex_;  // guards what follows
  WaveCounts counts_;

  std::chrono::steady_clock::time_point last_look_{};
  RelativeError last_error_;
  std::uint64_t last_error_samples_ = 0;
};

}  // namespace norrsken
