// What bsdf_benchmark and emitter_benchmark share: paths to ask models about, and telling the cost of one.
#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>

#include "base/aligned.h"
#include "compile/compile_testing.h"
#include "model_kernels.h"

namespace norrsken {

inline const SceneTables& tables_of(const testing::Compiled& compiled) {
  if (!compiled.scene) throw std::runtime_error(compiled.messages().at(0));
  return compiled.tables();
}

/// As many paths as a wave has, with random directions.
class ModelPaths {
 public:
  static constexpr std::uint32_t kCount = 1024;

  ModelPaths(const SceneView& scene, std::uint32_t place) : block_(kFields * kStride) {
    arrays_ = {&scene, kCount, field(kPlace), {}, {}, {}, {}, field(kDistance), {}};
    for (std::uint32_t k = 0; k < 3; ++k) {
      arrays_.wo[k] = field(kWo + k), arrays_.u[k] = field(kU + k);
      arrays_.wi[k] = field(kWi + k), arrays_.reference[k] = field(kReference + k);
    }
    for (std::uint32_t k = 0; k < 8; ++k) arrays_.out[k] = field(kOut + k);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      std::memcpy(field(kPlace) + i, &place, sizeof place);
      set_direction(kWo, i, unit(random), unit(random));
      // Some light comes from beyond the surface.
      set_direction(kWi, i, i % 8 == 0 ? -unit(random) : unit(random), unit(random));
      for (std::uint32_t k = 0; k < 3; ++k) {
        field(kU + k)[i] = unit(random);
        field(kReference + k)[i] = 2 * unit(random) - 1;
      }
    }
  }

  ModelPaths(ModelPaths&&) = default;  // what is moved stays where it is

  const ModelArrays& arrays() const { return arrays_; }

  /// Makes `wi` the directions to the points that the light was sampled at.
  void look_at_samples() {
    for (std::uint32_t i = 0; i < kCount; ++i) {
      float d[3], length2 = 0;
      for (std::uint32_t k = 0; k < 3; ++k) {
        d[k] = field(kOut + k)[i] - field(kReference + k)[i];
        length2 += d[k] * d[k];
      }
      for (std::uint32_t k = 0; k < 3; ++k) field(kWi + k)[i] = d[k] / std::sqrt(length2);
      field(kDistance)[i] = std::sqrt(length2);
    }
  }

 private:
  enum : std::uint32_t {
    kPlace,
    kWo,
    kWi = kWo + 3,
    kU = kWi + 3,
    kReference = kU + 3,
    kDistance = kReference + 3,
    kOut,
    kFields = kOut + 8
  };

  /// As in a wave's queues: with a stride of 4 KB all fields would share the sets of the cache.
  static constexpr std::uint32_t kStride = kCount + kMaxLanes;

  float* field(std::uint32_t k) { return block_.data() + std::size_t{k} * kStride; }
  void set_direction(std::uint32_t first, std::uint32_t i, float z, float turn) {
    const float r = std::sqrt(1 - z * z);
    field(first)[i] = r * std::cos(6.2831853f * turn);
    field(first + 1)[i] = r * std::sin(6.2831853f * turn);
    field(first + 2)[i] = z;
  }

  AlignedVector<float> block_;
  ModelArrays arrays_{};
};

/// MODEL/OPERATION/ISA, with the nanoseconds of one path beside the time of all.
template <class MakePaths>
void register_model(const std::string& name, const ModelKernels& kernels, ModelKernels::Kernel kernel,
                    MakePaths make_paths) {
  if (kernel == nullptr) return;
  benchmark::RegisterBenchmark((name + "/" + kernels.name).c_str(), [kernel, make_paths](benchmark::State& state) {
    const ModelPaths paths = make_paths();
    for (auto _ : state) kernel(paths.arrays());
    state.counters["ns/path"] = benchmark::Counter(
        ModelPaths::kCount * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  });
}

inline int run_benchmarks(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 64;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace norrsken
