// Whole renders of a large mesh through Embree against a bare loop over rtcIntersect1 and rtcOccluded1 with the very rays
// of the render: million rays a second of both, and their ratio.
//
//   mesh_render [--triangles N] [--size N] [--spp N] [--rounds N] [--threads N...] [--isa NAME]
//
// The scene is the displaced sphere of make_mesh inside the hexagon room. The waves of the render are traced stage by
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
#include "render/crew.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

struct Settings {
  std::uint32_t triangles = 1'000'000;
  int size = 400, spp = 16, rounds = 5;
  std::vector<int> threads = {1, 2};
  std::string isa = "auto";
};

Scene load_scene(const Settings& settings) {
  const TemporaryFolder folder;
  write_scene(sphere_grid(settings.triangles, false), "ply", folder.path());
  LoadOptions options;
  options.parameters = {{"shadow_rays", "1"}};
  options.width = options.height = settings.size;
  options.samples_per_pixel = settings.spp;
  const Result<Scene> scene = Scene::load(folder.file("scene.xml"), options);
  if (!scene) throw std::runtime_error(to_text(scene.diagnostics().all().at(0)));
  return *scene;
}

/// Rays that one stage sent off together.
struct Batch {
  bool shadow;
  std::vector<RTCRay> rays;
};

void keep_rays(const Queue& queue, bool shadow, std::vector<Batch>& batches) {
  static_assert(int{kRayOriginX} == int{kShadowOriginX} && int{kRayDirectionX} == int{kShadowDirectionX});
  Batch& batch = batches.emplace_back(Batch{shadow, {}});
  batch.rays.reserve(queue.count);
  for (std::uint32_t i = 0; i < queue.count; ++i) {
    const auto value = [&](std::uint32_t field) { return queue.field(field)[i]; };
    batch.rays.push_back({value(kRayOriginX), value(kRayOriginY), value(kRayOriginZ), 0.0f, value(kRayDirectionX),
                          value(kRayDirectionY), value(kRayDirectionZ), 0.0f,
                          shadow ? value(kShadowDistance) : __builtin_inff(), ~0u, 0u, 0u});
  }
}

/// trace_wave (src/wave/schedule.h) for scenes of models alone, one direction per hit, its rays kept.
void trace_and_keep(const SceneView& scene, const KernelEntry& kernels, const WaveJob& job, WaveMemory& memory,
                    std::vector<Batch>& batches) {
  kernels.generate_camera_rays(scene, job, memory.slots, memory.rays);
  const auto max_depth = static_cast<std::uint32_t>(scene.integrator.max_depth);
  for (std::uint32_t hit_number = 1; hit_number <= max_depth && memory.rays.count > 0; ++hit_number) {
    keep_rays(memory.rays, false, batches);
    for (Queue& hits : memory.hits) hits.count = 0;
    memory.light_hits.count = memory.next_rays.count = 0;
    const bool last = hit_number == max_depth && hit_number > 1;
    if (last) {
      kernels.intersect_emitters(scene, memory.rays, memory);
    } else {
      kernels.intersect_closest(scene, hit_number, hit_number == max_depth ? 0u : ~1u, memory.rays, memory);
    }
    kernels.shade_emission(scene, memory.light_hits, memory.slots);
    if (hit_number == max_depth) break;
    const bool roulette = hit_number >= static_cast<std::uint32_t>(scene.integrator.rr_depth);
    for (std::uint32_t kind = 1; kind < kModelCount; ++kind) {
      memory.shadow_rays.count = 0;
      kernels.shade_surface(scene, static_cast<BsdfKind>(kind), hit_number, roulette, memory.hits[kind], memory.slots,
                            memory.shadow_rays, memory.next_rays);
      keep_rays(memory.shadow_rays, true, batches);
      kernels.intersect_shadow(scene, memory.shadow_rays, memory.slots);
    }
    std::swap(memory.rays, memory.next_rays);
  }
}

std::uint64_t count_rays(const std::vector<Batch>& batches, bool shadow) {
  std::uint64_t count = 0;
  for (const Batch& batch : batches) count += batch.shadow == shadow ? batch.rays.size() : 0;
  return count;
}

std::vector<Batch> rays_of_render(const SceneView& scene, const KernelEntry& kernels, std::uint64_t samples) {
  WaveArena kept, whole;
  WaveCounts counts;
  std::vector<Batch> batches;
  const TileGrid grid(static_cast<std::uint32_t>(scene.film.width), static_cast<std::uint32_t>(scene.film.height),
                      kWaveSlots);
  const WorkPlan plan(grid, {0, static_cast<std::uint32_t>(samples)}, 0);
  for (std::uint64_t wave = 0; wave < plan.wave_count(); ++wave) {
    const WaveJob job = plan.wave(wave);
    trace_and_keep(scene, kernels, job, kept.memory(), batches);
    kernels.trace_wave(scene, job, whole.memory(), counts);
    for (std::uint32_t channel = kSlotRed; channel <= kSlotBlue; ++channel) {
      const float* a = kept.memory().slots.field(channel);
      if (!std::equal(a, a + job.slot_count(), whole.memory().slots.field(channel)))
        throw std::runtime_error("the rays that were kept are not those of the render");
    }
  }
  if (count_rays(batches, false) != counts.closest_rays || count_rays(batches, true) != counts.shadow_rays)
    throw std::runtime_error("other rays were kept than the render counts");
  return batches;
}

/// What became of a ray must be written down somewhere.
void trace_bare(RTCScene scene, const Batch& batch, bool intersect_all, std::vector<float>& distances) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  distances.resize(std::max(distances.size(), batch.rays.size()));
  for (std::size_t i = 0; i < batch.rays.size(); ++i) {
    if (batch.shadow && !intersect_all) {
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

void trace_all_bare(RTCScene scene, const std::vector<Batch>& batches, bool intersect_all, int threads) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    std::vector<float> distances;
    for (std::size_t i = next++; i < batches.size(); i = next++)
      trace_bare(scene, batches[i], intersect_all, distances);
  };
  std::vector<std::jthread> crew;
  crew.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) crew.emplace_back(work);
}

void render(const SceneView& scene, const KernelEntry& kernels, std::uint64_t samples, int threads) {
  const std::atomic<bool> cancelled{false};
  Film film(scene.film, scene.sampler.kind);
  const TileGrid grid = Crew::grid(scene, film.width(), film.height());
  Work work{.grid = grid,
            .samples = {},
            .feature_samples = {},
            .goal = {},
            .progress = TileProgress(grid.tile_count()),
            .feature_progress = {},
            .dropped = {}};
  work.set_goal(SampleGoal::uniform(grid, static_cast<std::uint32_t>(samples), false));
  Crew crew(scene, kernels, film, work, threads, cancelled);
  crew.run({std::chrono::milliseconds(100), [] { return true; }});
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

/// Million rays a second, medians over the rounds; and of each round's ratio of both kinds of seconds to those of the
/// render.
void print_row(const char* name, std::uint64_t rays, const std::vector<Seconds>& row,
               const std::vector<Seconds>& render_row) {
  const auto over_rounds = [&](auto value) {
    std::vector<double> values;
    for (std::size_t i = 0; i < row.size(); ++i) values.push_back(value(row[i], render_row[i]));
    return median(values);
  };
  const double count = static_cast<double>(rays) * 1e-6;
  fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", name,
             over_rounds([&](const Seconds& s, const Seconds&) { return count / s.clock; }),
             over_rounds([&](const Seconds& s, const Seconds&) { return count / s.processor; }),
             over_rounds([](const Seconds& s, const Seconds& r) { return s.clock / r.clock; }),
             over_rounds([](const Seconds& s, const Seconds& r) { return s.processor / r.processor; }));
}

void compare(const Settings& settings) {
  const Scene loaded = load_scene(settings);
  const KernelEntry* kernels = find_kernels(settings.isa.c_str());
  if (kernels == nullptr) throw std::runtime_error("no instruction set " + settings.isa);
  const BenchScene scene(std::shared_ptr<const SceneTables>(&loaded.tables().tables, [](auto*) {}), AccelKind::embree);
  const auto samples = static_cast<std::uint64_t>(settings.spp);
  const std::vector<Batch> batches = rays_of_render(scene.view(), *kernels, samples);
  const std::uint64_t closest = count_rays(batches, false), shadow = count_rays(batches, true);
  auto* embree = static_cast<RTCScene>(scene.view().accel.embree_scene);

  fmt::print("{} triangles, {}x{} pixels, {} samples each, {}: {:.2f} M closest hits and {:.2f} M shadow rays\n",
             scene.tables().triangle_count(), settings.size, settings.size, settings.spp, kernels->name,
             static_cast<double>(closest) * 1e-6, static_cast<double>(shadow) * 1e-6);
  for (const int threads : settings.threads) {
    std::vector<Seconds> whole, bare, bare_intersect;
    for (int round = 0; round < settings.rounds; ++round) {
      whole.push_back(seconds_of(threads, [&] { render(scene.view(), *kernels, samples, threads); }));
      bare.push_back(seconds_of(threads, [&] { trace_all_bare(embree, batches, false, threads); }));
      bare_intersect.push_back(seconds_of(threads, [&] { trace_all_bare(embree, batches, true, threads); }));
    }
    fmt::print(
        "\n| {} thread{} | Mrays/s by the clock | by the processor | render / this, clock | processor |\n"
        "|---|---|---|---|---|\n",
        threads, threads == 1 ? "" : "s");
    print_row("whole render", closest + shadow, whole, whole);
    print_row("bare rtcIntersect1 and rtcOccluded1", closest + shadow, bare, whole);
    print_row("bare rtcIntersect1 for all", closest + shadow, bare_intersect, whole);
  }
}

}  // namespace
}  // namespace norrsken

int main(int argc, char** argv) try {
  CLI::App app{"Renders of a large mesh against a bare loop over Embree with the same rays."};
  norrsken::Settings settings;
  app.add_option("--triangles", settings.triangles, "about how many")->check(CLI::Range(1000u, 100'000'000u));
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
