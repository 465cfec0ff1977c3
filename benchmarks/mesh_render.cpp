// Whole renders of a large mesh, through the hierarchy and through Embree, against a bare loop over rtcIntersect1 and
// rtcOccluded1 with the very rays of the render, and against the hierarchy with the same: million rays a second of each, and
// their ratio to the first.
//
//   mesh_render [--triangles N] [--scene FILE] [--size N] [--spp N] [--rounds N] [--threads N...] [--isa NAME]
//
// The scene is the displaced sphere of make_mesh inside the hexagon room, or a file's. The waves of the render are traced stage by
// stage and their rays kept; that they are the render's is checked by what every path brings home. Bare loops and renders
// take turns.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <stdexcept>
#include <thread>
#include <vector>

#include "displaced_sphere.h"
#include "kernel_bench.h"
#include "render/worker_pool.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

struct Settings {
  std::uint32_t triangles = 1'000'000;
  int size = 400, spp = 16, rounds = 5;
  std::vector<int> threads = {1, 2};
  std::string isa = "auto", scene;
};

Scene load_scene(const Settings& settings) {
  const TemporaryFolder folder;
  LoadOptions options;
  std::string file = settings.scene;
  if (file.empty()) {
    write_scene(sphere_grid(settings.triangles, false), "ply", folder.path());
    options.parameters = {{"shadow_rays", "1"}};
    file = folder.file("scene.xml");
  }
  options.width = options.height = settings.size;
  options.samples_per_pixel = settings.spp;
  const Result<Scene> scene = Scene::load(file, options);
  if (!scene) throw std::runtime_error(to_text(scene.diagnostics().all().at(0)));
  return *scene;
}

/// Rays that one stage sent off together.
struct Batch {
  bool shadow;
  std::vector<RTCRay> rays;
  AlignedVector<float> fields;  ///< the same as arrays: origins, directions, distances

  std::size_t stride() const { return (rays.size() + kMaxLanes) / kMaxLanes * kMaxLanes; }
  const float* field(std::size_t k) const { return fields.data() + k * stride(); }
  RayArrays arrays() const {
    return {field(0), field(1), field(2), field(3), field(4), field(5), static_cast<std::uint32_t>(rays.size())};
  }
};

/// Of RAYS or SHADOW RAYS.
template <class Record>
void keep_rays(const Queue<Record>& queue, std::vector<Batch>& batches) {
  constexpr bool shadow = std::is_same_v<Record, stored::ShadowRay>;
  if (queue.count == 0) return;
  Batch& batch = batches.emplace_back(Batch{shadow, {}, {}});
  batch.rays.reserve(queue.count);
  for (std::uint32_t i = 0; i < queue.count; ++i) {
    const Record ray = queue[i];
    float t_max = __builtin_inff();
    if constexpr (shadow) t_max = ray.t_max;
    const auto &o = ray.origin, &d = ray.direction;
    batch.rays.push_back({o[0], o[1], o[2], 0.0f, d[0], d[1], d[2], 0.0f, t_max, ~0u, 0u, 0u});
  }
  batch.fields.resize(7 * batch.stride());
  const auto keep = [&](std::uint32_t k, const float* field) {
    std::copy_n(field, queue.count, batch.fields.data() + k * batch.stride());
  };
  for (std::uint32_t k = 0; k < 3; ++k) {
    keep(k, queue.field(&Record::origin, k));
    keep(3 + k, queue.field(&Record::direction, k));
  }
  if constexpr (shadow) keep(6, queue.field(&Record::t_max));
}

/// Told of every step of a wave, it keeps the rays that are about to be asked.
void keep_event(void* batches, WaveEvent event, const WaveMemory& memory) {
  auto& to = *static_cast<std::vector<Batch>*>(batches);
  if (event == WaveEvent::camera_rays || event == WaveEvent::next_rays) keep_rays(memory.rays, to);
  if (event == WaveEvent::shadow_rays) keep_rays(memory.shadow_rays, to);
}

std::uint64_t count_rays(const std::vector<Batch>& batches, bool shadow) {
  std::uint64_t count = 0;
  for (const Batch& batch : batches) count += batch.shadow == shadow ? batch.rays.size() : 0;
  return count;
}

std::vector<Batch> rays_of_render(const SceneView& scene, const KernelEntry& kernels, std::uint64_t samples) {
  WaveArena arena;
  WaveCounts counts;
  std::vector<Batch> batches;
  arena.memory().observer = {keep_event, &batches};
  const TileGrid grid(static_cast<std::uint32_t>(scene.film.width), static_cast<std::uint32_t>(scene.film.height),
                      kWaveSlots);
  const WorkPlan plan(grid, {0, static_cast<std::uint32_t>(samples)}, 0);
  for (std::uint64_t wave = 0; wave < plan.wave_count(); ++wave) {
    kernels.trace_wave(scene, plan.wave(wave), arena.memory(), counts);
  }
  if (count_rays(batches, false) != counts.closest_rays || count_rays(batches, true) != counts.shadow_rays)
    throw std::runtime_error("other rays were kept than the render counts");
  return batches;
}

/// The hierarchy alone.
void trace_hierarchy(const SceneView& scene, const KernelEntry& kernels, const Batch& batch) {
  AlignedVector<float> t(batch.rays.size() + kMaxLanes);
  AlignedVector<std::uint32_t> primitives(batch.rays.size() + kMaxLanes);
  AlignedVector<std::uint8_t> occluded(batch.rays.size());
  const RayArrays rays = batch.arrays();
  if (batch.shadow) {
    kernels.occluded_rays(scene, rays, batch.field(6), occluded.data());
  } else {
    probe_of(kernels).closest_rays(scene, false, rays, t.data(), primitives.data());
  }
}

/// What became of a ray must be written down somewhere.
void trace_bare(RTCScene scene, const Batch& batch) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::vector<float> distances(batch.rays.size());
  for (std::size_t i = 0; i < batch.rays.size(); ++i) {
    if (batch.shadow) {
      RTCRay ray = batch.rays[i];
      rtcOccluded1(scene, &context, &ray);
      distances[i] = ray.tfar;
    } else {
      RTCRayHit hit;
      hit.ray = batch.rays[i];
      hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &hit);
      distances[i] = hit.ray.tfar;
    }
  }
}

/// `trace` of every batch, by so many threads.
template <class Trace>
void trace_all(const std::vector<Batch>& batches, int threads, const Trace& trace) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < batches.size(); i = next++) trace(batches[i]);
  };
  std::vector<std::jthread> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) workers.emplace_back(work);
}

void render(const SceneView& scene, const KernelEntry& kernels, std::uint64_t samples, int threads) {
  const std::atomic<bool> cancelled{false};
  Film film(scene.film, scene.sampler.kind);
  const TileGrid grid = WorkerPool::grid(scene, film.width(), film.height());
  Work work{.grid = grid,
            .samples = {},
            .feature_samples = {},
            .goal = {},
            .progress = TileProgress(grid.tile_count()),
            .feature_progress = {},
            .dropped = {}};
  work.set_goal(SampleGoal::uniform(grid, static_cast<std::uint32_t>(samples), false));
  WorkerPool workers(scene, kernels, film, work, threads, cancelled);
  workers.run({std::chrono::milliseconds(100), [] { return true; }});
}

/// By the clock, and by the processor: all threads' seconds over their number, which other work disturbs less.
struct Seconds {
  double clock, processor;
};

template <class Body>
Seconds seconds_of(int threads, Body body) {
  const auto processor = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const auto begin = std::chrono::steady_clock::now();
  const double processor_begin = processor();
  body();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          (processor() - processor_begin) / threads};
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Million rays a second, medians over the rounds; and of each round's ratio of both kinds of rates to those of the
/// bare loop.
void print_row(const char* name, std::uint64_t rays, const std::vector<Seconds>& row,
               const std::vector<Seconds>& bare_row) {
  const auto over_rounds = [&](auto value) {
    std::vector<double> values;
    for (std::size_t i = 0; i < row.size(); ++i) values.push_back(value(row[i], bare_row[i]));
    return median(values);
  };
  const double count = static_cast<double>(rays) * 1e-6;
  fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", name,
             over_rounds([&](const Seconds& s, const Seconds&) { return count / s.clock; }),
             over_rounds([&](const Seconds& s, const Seconds&) { return count / s.processor; }),
             over_rounds([](const Seconds& s, const Seconds& b) { return b.clock / s.clock; }),
             over_rounds([](const Seconds& s, const Seconds& b) { return b.processor / s.processor; }));
}

void compare(const Settings& settings) {
  const Scene loaded = load_scene(settings);
  const KernelEntry* kernels = find_kernels(settings.isa.c_str());
  if (kernels == nullptr) throw std::runtime_error("no instruction set " + settings.isa);
  const std::shared_ptr<const SceneTables> tables(&loaded.tables().tables, [](auto*) {});
  const BenchScene own(tables, AccelKind::bvh), through_embree(tables, AccelKind::embree);
  const auto samples = static_cast<std::uint64_t>(settings.spp);
  const std::vector<Batch> batches = rays_of_render(own.view(), *kernels, samples);
  const std::uint64_t closest = count_rays(batches, false), shadow = count_rays(batches, true);
  auto* embree = static_cast<RTCScene>(through_embree.view().accel.embree_scene);

  fmt::print("{} triangles, {}x{} pixels, {} samples each, {}: {:.2f} M closest hits and {:.2f} M shadow rays\n",
             tables->triangle_count(), settings.size, settings.size, settings.spp, kernels->name,
             static_cast<double>(closest) * 1e-6, static_cast<double>(shadow) * 1e-6);
  for (const int threads : settings.threads) {
    std::vector<Seconds> whole, bare, hierarchy, whole_embree;
    for (int round = 0; round < settings.rounds; ++round) {
      whole.push_back(seconds_of(threads, [&] { render(own.view(), *kernels, samples, threads); }));
      bare.push_back(seconds_of(
          threads, [&] { trace_all(batches, threads, [&](const Batch& batch) { trace_bare(embree, batch); }); }));
      hierarchy.push_back(seconds_of(threads, [&] {
        trace_all(batches, threads, [&](const Batch& batch) { trace_hierarchy(own.view(), *kernels, batch); });
      }));
      whole_embree.push_back(seconds_of(threads, [&] { render(through_embree.view(), *kernels, samples, threads); }));
    }
    fmt::print(
        "\n| {} thread{} | Mrays/s by the clock | by the processor | this / bare Embree, clock | processor |\n"
        "|---|---|---|---|---|\n",
        threads, threads == 1 ? "" : "s");
    print_row("bare rtcIntersect1 and rtcOccluded1", closest + shadow, bare, bare);
    print_row("whole render", closest + shadow, whole, bare);
    print_row("hierarchy alone", closest + shadow, hierarchy, bare);
    print_row("whole render through Embree", closest + shadow, whole_embree, bare);
  }
}

}  // namespace
}  // namespace norrsken

int main(int argc, char** argv) try {
  CLI::App app{"Renders of a large mesh against bare loops with the same rays."};
  norrsken::Settings settings;
  app.add_option("--triangles", settings.triangles, "about how many")->check(CLI::Range(1000u, 100'000'000u));
  app.add_option("--scene", settings.scene, "a file of triangles and spheres instead")->check(CLI::ExistingFile);
  app.add_option("--size", settings.size, "pixels a side")->check(CLI::Range(16, 4096));
  app.add_option("--spp", settings.spp, "samples per pixel")->check(CLI::Range(1, 4096));
  app.add_option("--rounds", settings.rounds, "of which the medians are told")->check(CLI::Range(1, 1000));
  app.add_option("--threads", settings.threads, "numbers of threads, one table each")->check(CLI::Range(1, 1024));
  app.add_option("--isa", settings.isa, "instruction set of the render");
  CLI11_PARSE(app, argc, argv);
  norrsken::compare(settings);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "mesh_render: {}\n", error.what());
  return 1;
}
