// What the benchmarks share: scenes with a view for kernels, rays, and waves stopped in front of a stage.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/aligned.h"
#include "isa/probe_testing.h"
#include "norrsken/scene.h"
#include "render/scene_view.h"
#include "render/wave_arena.h"

namespace norrsken {

/// A scene that lives as long as the program.
class BenchScene {
 public:
  BenchScene(std::shared_ptr<const SceneTables> tables, AccelKind kind);
  const SceneView& view() const { return view_; }
  const SceneTables& tables() const { return *tables_; }

 private:
  std::shared_ptr<const SceneTables> tables_;
  Accel accel_;
  SceneView view_;
};

/// The hexagon room with one shadow ray per hit and independent samples.
const BenchScene& bench_room(AccelKind kind);

/// The room's camera and light around a bumpy sphere of about so many triangles, no two of which are coplanar.
const BenchScene& bench_sphere_mesh(int triangles, AccelKind kind);

/// 16,384 rays: from the camera through neighbouring pixels, or from anywhere inside in any direction.
class BenchRays {
 public:
  BenchRays(const BenchScene& scene, bool coherent);
  const RayArrays& arrays() const { return arrays_; }
  float* t() const { return t_; }
  std::uint32_t* primitives() const { return reinterpret_cast<std::uint32_t*>(primitives_); }

 private:
  AlignedVector<float> block_;
  RayArrays arrays_{};
  float* t_ = nullptr;
  float* primitives_ = nullptr;
};

}  // namespace norrsken
