// The intersectors on incoherent and coherent rays: rays per second on one core, per instruction set. The displaced
// spheres of growing triangle count show where Embree overtakes the planes (planes_up_to in src/accel/build.h).
#include <benchmark/benchmark.h>

#include "kernel_bench.h"

namespace norrsken {
namespace {

void closest(benchmark::State& state, const KernelEntry& kernels, const BenchScene& scene, bool coherent) {
  const BenchRays rays(scene, coherent);
  for (auto _ : state) {
    kernels.closest_rays(scene.view(), coherent, rays.arrays(), rays.t(), rays.primitives());
    benchmark::ClobberMemory();
  }
  state.counters["Mrays/s"] = benchmark::Counter(static_cast<double>(rays.arrays().count) * 1e-6,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

void occluded(benchmark::State& state, const KernelEntry& kernels, const BenchScene& scene) {
  const BenchRays rays(scene, false);
  std::vector<std::uint8_t> answers(rays.arrays().count);
  for (std::uint32_t i = 0; i < rays.arrays().count; ++i) rays.t()[i] = 4.0f;
  for (auto _ : state) {
    kernels.occluded_rays(scene.view(), rays.arrays(), rays.t(), answers.data());
    benchmark::ClobberMemory();
  }
  state.counters["Mrays/s"] = benchmark::Counter(static_cast<double>(rays.arrays().count) * 1e-6,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

void register_all() {
  for (const AccelKind kind : {AccelKind::planes, AccelKind::moller_trumbore, AccelKind::embree}) {
    const BenchScene& room = bench_room(kind);
    for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
      const std::string suffix = std::string("/room/") + accel_name(kind) + "/" + (*k)->name;
      benchmark::RegisterBenchmark(("closest" + suffix).c_str(),
                                   [k, &room](auto& state) { closest(state, **k, room, false); });
      benchmark::RegisterBenchmark(("camera" + suffix).c_str(),
                                   [k, &room](auto& state) { closest(state, **k, room, true); });
      benchmark::RegisterBenchmark(("occluded" + suffix).c_str(),
                                   [k, &room](auto& state) { occluded(state, **k, room); });
    }
  }
  for (const int triangles : {16, 32, 64, 128, 256, 512, 1024, 4096}) {
    for (const AccelKind kind : {AccelKind::planes, AccelKind::moller_trumbore, AccelKind::embree}) {
      if (kind != AccelKind::embree && triangles > 1024) continue;
      const BenchScene& mesh = bench_sphere_mesh(triangles, kind);
      for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
        const std::string name =
            "closest/mesh_" + std::to_string(triangles) + "/" + accel_name(kind) + "/" + (*k)->name;
        benchmark::RegisterBenchmark(name.c_str(), [k, &mesh](auto& state) { closest(state, **k, mesh, false); });
      }
    }
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
