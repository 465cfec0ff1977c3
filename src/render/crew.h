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
#include "render/work_plan.h"

namespace norrsken {

/// Threads to use: the number asked for, or one per hardware thread for 0.
int crew_size(int asked);

class Crew {
 public:
  /// Borrows everything. Setting `cancelled` makes `run` return when the waves under way are on the film.
  Crew(const SceneView& scene, const KernelEntry& kernels, Film& film, int threads, const std::atomic<bool>& cancelled);
  ~Crew();

  /// Renders the feature layers with so many samples per pixel.
  void run_features(std::uint32_t samples, const std::function<void()>& tick);

  /// Renders so many samples per pixel; calls `tick` from the calling thread about ten times a second.
  void run(std::uint64_t samples, const std::function<void()>& tick);

  std::uint64_t samples_done() const { return samples_done_.load(std::memory_order_relaxed); }
  /// Of what is on the film, looked at about once a second; -1 while unknown.
  double relative_error();
  RenderStatistics statistics() const;

 private:
  struct Tile;
  enum class Pass { radiance, features, particles };

  void run_pass(Pass pass, const WorkPlan& plan, const std::function<void()>& tick);
  void work(Pass pass, const WorkPlan& plan, std::atomic<std::uint64_t>& next_wave, WaveMemory& memory);
  void add_to_film(Pass pass, const WorkPlan& plan, std::uint64_t wave, WaveMemory& memory);
  void trace_particles(const WorkPlan& plan, std::uint64_t wave, WaveMemory& memory, WaveCounts& counts);
  void keep_dropped(const DroppedSamples& dropped);

  const SceneView& scene_;
  SceneView feature_scene_;  ///< the same, with what features need
  const KernelEntry& kernels_;
  Film& film_;
  FilmView film_view_;
  int threads_;
  int threads_used_ = 0;
  const std::atomic<bool>& cancelled_;
  std::atomic<bool> stop_{false};  ///< set while leaving `run` by an exception

  std::unique_ptr<Tile[]> tiles_;
  std::uint64_t tile_count_ = 0;
  std::atomic<std::uint64_t> samples_done_{0};

  mutable std::mutex mutex_;  // guards what follows
  WaveCounts counts_;
  DroppedSamples dropped_;

  std::chrono::steady_clock::time_point last_look_{};
  double last_error_ = -1;
  std::uint64_t last_error_samples_ = 0;
};

}  // namespace norrsken
