// The intersectors on incoherent and coherent rays: rays per second on one core, per instruction set. The displaced
// spheres of growing triangle count show where the hierarchy overtakes the planes (planes_up_to in src/accel/build.h); on the
// largest, `bare` is nothing but a loop over rtcIntersect1 with the same rays.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "kernel_bench.h"

namespace norrsken {
namespace {

void closest(benchmark::State& state, const KernelEntry& kernels, const BenchScene& scene, bool coherent) {
  const BenchRays rays(scene, coherent);
  for (auto _ : state) {
    probe_of(kernels).closest_rays(scene.view(), coherent, rays.arrays(), rays.t(), rays.primitives());
    benchmark::ClobberMemory();
  }
  state.counters["Mrays/s"] = benchmark::Counter(static_cast<double>(rays.arrays().count) * 1e-6,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

void bare(benchmark::State& state, const BenchScene& scene, bool coherent) {
  const BenchRays rays(scene, coherent);
  const RayArrays& r = rays.arrays();
  auto* embree = static_cast<RTCScene>(scene.view().accel.embree_scene);
  for (auto _ : state) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::uint32_t i = 0; i < r.count; ++i) {
      RTCRayHit one;
      one.ray = {r.ox[i], r.oy[i], r.oz[i], 0.0f, r.dx[i], r.dy[i], r.dz[i], 0.0f, __builtin_inff(), ~0u, 0u, 0u};
      one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(embree, &context, &one);
      rays.t()[i] = one.ray.tfar;
      rays.primitives()[i] = one.hit.primID;
    }
    benchmark::ClobberMemory();
  }
  state.counters["Mrays/s"] =
      benchmark::Counter(static_cast<double>(r.count) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
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
  for (const AccelKind kind : {AccelKind::planes, AccelKind::moller_trumbore, AccelKind::bvh, AccelKind::embree}) {
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
    for (const AccelKind kind : {AccelKind::planes, AccelKind::moller_trumbore, AccelKind::bvh, AccelKind::embree}) {
      if ((kind == AccelKind::planes || kind == AccelKind::moller_trumbore) && triangles > 1024) continue;
      const BenchScene& mesh = bench_sphere_mesh(triangles, kind);
      for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
        const std::string name =
            "closest/mesh_" + std::to_string(triangles) + "/" + accel_name(kind) + "/" + (*k)->name;
        benchmark::RegisterBenchmark(name.c_str(), [k, &mesh](auto& state) { closest(state, **k, mesh, false); });
      }
    }
  }
  // Built when it is first asked for: it takes seconds.
  for (const bool coherent : {false, true}) {
    const std::string rays = coherent ? "camera" : "closest";
    const auto mesh = [](AccelKind kind) { return &bench_sphere_mesh(1'000'000, kind); };
    benchmark::RegisterBenchmark((rays + "/mesh_1000000/bare").c_str(),
                                 [coherent, mesh](auto& state) { bare(state, *mesh(AccelKind::embree), coherent); });
    for (const AccelKind kind : {AccelKind::bvh, AccelKind::embree}) {
      for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
        benchmark::RegisterBenchmark(
            (rays + "/mesh_1000000/" + accel_name(kind) + "/" + (*k)->name).c_str(),
            [k, coherent, mesh, kind](auto& state) { closest(state, **k, *mesh(kind), coherent); });
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
