// Each stage alone on the hexagon room's own second bounce, and whole waves: what a record costs, per instruction set.
#include <benchmark/benchmark.h>

#include "kernel_bench.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kDiffuse = static_cast<std::uint32_t>(BsdfKind::diffuse);

/// A wave traced up to the shading of its second hits, with that instruction set.
struct StoppedWave {
  const SceneView& scene;
  const KernelProbe& kernels;
  WaveArena arena;
  WaveMemory& memory = arena.memory();
  WaveJob job{320, 480, 16, 4, 0, 16};

  StoppedWave(const SceneView& s, const KernelEntry& k) : scene(s), kernels(probe_of(k)) {
    kernels.generate_camera_rays(scene, job, memory.slots, memory.rays);
    kernels.intersect_closest(scene, true, ~1u, memory.rays, memory.slots, memory.found);
    kernels.shade_surface(scene, BsdfKind::diffuse, 1, false, memory.found.hits[kDiffuse], memory.slots,
                          memory.shadow_rays, memory.next_rays);
    std::swap(memory.rays, memory.next_rays);
    clear();
    kernels.intersect_closest(scene, false, ~1u, memory.rays, memory.slots, memory.found);
    kernels.shade_surface(scene, BsdfKind::diffuse, 2, false, memory.found.hits[kDiffuse], memory.slots,
                          memory.shadow_rays, memory.next_rays);
  }
  void clear() {
    for (auto& q : memory.found.hits) q.count = 0;
    memory.found.light_hits.count = memory.shadow_rays.count = memory.next_rays.count = 0;
  }
};

void per_record(benchmark::State& state, std::uint32_t records) {
  state.counters["Mrecords/s"] =
      benchmark::Counter(static_cast<double>(records) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
}

template <class Body>
void stage(const std::string& name, const KernelEntry& kernels, Body body) {
  benchmark::RegisterBenchmark((name + "/" + kernels.name).c_str(), [&kernels, body](benchmark::State& state) {
    StoppedWave wave(bench_room(AccelKind::planes).view(), kernels);
    const std::uint32_t records = body(wave);
    for (auto _ : state) benchmark::DoNotOptimize(body(wave));
    per_record(state, records);
  });
}

void register_stages(const KernelEntry& kernels) {
  stage("generate_camera_rays", kernels, [&](StoppedWave& w) {
    w.kernels.generate_camera_rays(w.scene, w.job, w.memory.slots, w.memory.next_rays);
    return w.memory.next_rays.count;
  });
  stage("intersect_closest", kernels, [&](StoppedWave& w) {
    for (auto& q : w.memory.found.hits) q.count = 0;
    w.memory.found.light_hits.count = 0;
    w.kernels.intersect_closest(w.scene, false, ~1u, w.memory.rays, w.memory.slots, w.memory.found);
    return w.memory.rays.count;
  });
  stage("intersect_emitters", kernels, [&](StoppedWave& w) {
    w.memory.found.light_hits.count = 0;
    w.kernels.intersect_emitters(w.scene, w.memory.rays, w.memory.slots, w.memory.found);
    return w.memory.rays.count;
  });
  stage("shade_surface_diffuse", kernels, [&](StoppedWave& w) {
    w.memory.shadow_rays.count = w.memory.next_rays.count = 0;
    w.kernels.shade_surface(w.scene, BsdfKind::diffuse, 2, false, w.memory.found.hits[kDiffuse], w.memory.slots,
                            w.memory.shadow_rays, w.memory.next_rays);
    return w.memory.found.hits[kDiffuse].count;
  });
  stage("intersect_shadow", kernels, [&](StoppedWave& w) {
    w.kernels.intersect_shadow(w.scene, w.memory.shadow_rays, w.memory.slots);
    return w.memory.shadow_rays.count;
  });
  stage("accumulate_film", kernels, [&](StoppedWave& w) {
    static std::vector<double> high(6 * 800 * 800), low(6 * 800 * 800);
    static std::vector<std::uint32_t> counts(800 * 800);
    DroppedSamples dropped;
    FilmView film;
    film.sums = {high.data(), low.data()};
    film.counts = counts.data();
    film.width = film.height = 800;
    kernels.accumulate_film(w.job, SamplerKind::independent, w.memory.slots, film, dropped);
    return w.job.slot_count();
  });
}

void whole_wave(benchmark::State& state, const KernelEntry& kernels, SamplerKind sampler) {
  SceneView scene = bench_room(AccelKind::planes).view();
  scene.sampler.kind = sampler;
  WaveArena arena;
  WaveCounts counts;
  std::uint32_t x = 0;
  std::uint64_t samples = 0;
  for (auto _ : state) {
    const WaveJob job{x % 784, (x * 7) % 796, 16, 4, 0, 16};
    x += 16;
    kernels.trace_wave(scene, job, arena.memory(), counts);
    samples += job.slot_count();
  }
  state.counters["Msamples/s"] = benchmark::Counter(static_cast<double>(samples) * 1e-6, benchmark::Counter::kIsRate);
  state.counters["Mrays/s"] = benchmark::Counter(static_cast<double>(counts.closest_rays + counts.shadow_rays) * 1e-6,
                                                 benchmark::Counter::kIsRate);
}

void register_all() {
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    register_stages(**k);
    benchmark::RegisterBenchmark((std::string("room/independent/") + (*k)->name).c_str(),
                                 [k](auto& state) { whole_wave(state, **k, SamplerKind::independent); });
    benchmark::RegisterBenchmark((std::string("room/sobol/") + (*k)->name).c_str(),
                                 [k](auto& state) { whole_wave(state, **k, SamplerKind::sobol); });
  }
}

}  // namespace
}  // namespace norrsken

int main(int argc, char** argv) {
  norrsken::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 64;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
