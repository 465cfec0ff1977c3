#include "norrsken/path_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compile/compile.h"
#include "isa/entry.h"
#include "render/scene_state.h"
#include "render/scene_view.h"
#include "render/wave_arena.h"
#include "render/worker_pool.h"

namespace norrsken {
namespace {

constexpr const char* kBsdfNames[] = {
    "absorb",
#define NORRSKEN_BSDF(kind, Model) #kind,
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
#define NORRSKEN_BSDF_RESOLVED(kind, Adapter) #kind,
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_RESOLVED
};

/// Follows a wave of one slot.
class PathObserver {
 public:
  PathObserver(const SceneView& scene, const KernelEntry& kernels) : scene_(scene), kernels_(kernels) {}

  WaveObserver observer() {
    return {[](void* self, WaveEvent event, const WaveMemory& memory) {
              static_cast<PathObserver*>(self)->see(event, memory);
            },
            this};
  }
  PathTrace take(const WaveMemory& memory) {
    trace_.radiance = memory.slots[0].radiance;
    return std::move(trace_);
  }

 private:
  void see(WaveEvent event, const WaveMemory& memory) {
    switch (event) {
      case WaveEvent::camera_rays:
      case WaveEvent::next_rays:
        add_ray(memory.rays);
        break;
      case WaveEvent::intersected:
        add_hit(memory);
        break;
      case WaveEvent::resolved:
        for (const auto& hits : memory.found.hits) {
          if (hits.count > 0) vertex().bsdf += " > " + bsdf_of(hits);
        }
        break;
      case WaveEvent::emission:
        add_emission(memory.slots);
        break;
      case WaveEvent::shadow_rays:
        add_light_samples(memory);
        break;
    }
  }

  PathVertex& vertex() { return trace_.vertices.back(); }

  static std::string bsdf_of(const Queue<stored::Hit>& hits) {
    return kBsdfNames[static_cast<std::size_t>(material_kind(hits[0].material))];
  }

  void add_ray(const Queue<stored::Ray>& rays) {
    if (rays.count == 0) return;
    const stored::Ray ray = rays[0];
    PathVertex v;
    v.origin = ray.origin;
    v.direction = ray.direction;
    v.throughput = ray.throughput;
    v.pdf_sa = ray.pdf_sa;
    trace_.vertices.push_back(std::move(v));
  }

  void add_hit(const WaveMemory& memory) {
    const auto look = [&](const Queue<stored::Hit>& hits) {
      if (hits.count == 0) return;
      PathVertex& v = vertex();
      v.hit = true;
      v.distance = hits[0].t;
      for (std::size_t k = 0; k < 3; ++k) v.position[k] = std::fma(v.direction[k], v.distance, v.origin[k]);
      const std::uint32_t primitive = hits[0].primitive;
      v.shape = scene_.surfaces[primitive].shape;
      v.primitive = primitive - scene_.shapes[v.shape].first_primitive;
      v.bsdf = bsdf_of(hits);
    };
    look(memory.found.light_hits);
    for (const auto& hits : memory.found.hits) look(hits);
    look(memory.found.unresolved_hits);
  }

  void add_emission(const Queue<stored::Slot>& slots) {
    const Triple radiance = slots[0].radiance;
    for (std::size_t k = 0; k < 3; ++k) vertex().emission[k] += radiance[k] - before_[k];
    before_ = radiance;
  }

  void add_light_samples(const WaveMemory& memory) {
    const Queue<stored::ShadowRay>& rays = memory.shadow_rays;
    std::string bsdf;
    for (const auto& hits : memory.found.hits) {
      if (hits.count > 0) bsdf = bsdf_of(hits);
    }
    std::vector<std::uint8_t> occluded(rays.capacity());
    const auto origin = [&](std::uint32_t k) { return rays.field(&stored::ShadowRay::origin, k); };
    const auto direction = [&](std::uint32_t k) { return rays.field(&stored::ShadowRay::direction, k); };
    kernels_.occluded_rays(scene_,
                           {origin(0), origin(1), origin(2), direction(0), direction(1), direction(2), rays.count},
                           rays.field(&stored::ShadowRay::t_max), occluded.data());
    for (std::uint32_t i = 0; i < rays.count; ++i) {
      const stored::ShadowRay ray = rays[i];
      PathVertex::LightSample s{bsdf, ray.origin, ray.direction, ray.t_max, ray.contribution, occluded[i] == 0};
      if (s.reached) {
        for (std::size_t k = 0; k < 3; ++k) before_[k] += s.contribution[k];
      }
      vertex().light_samples.push_back(std::move(s));
    }
  }

  const SceneView& scene_;
  const KernelEntry& kernels_;
  PathTrace trace_;
  Triple before_{};  ///< of the slot's radiance, what is accounted for
};

}  // namespace

Result<PathTrace> trace_path(const Scene& scene, const RenderOptions& options, int x, int y, std::uint32_t sample) {
  Diagnostics diagnostics(options.log);
  const SceneTables& tables = scene.tables().tables;
  const SceneFrame& frame = scene.frame();
  const KernelEntry* kernels = choose_kernels(options.isa, diagnostics);
  const AccelKind accel_kind =
      choose_accel(options.accelerator, tables, frame.layers, kernels != nullptr ? kernels->lanes : 1, diagnostics);
  if (x < 0 || y < 0 || x >= frame.film.width || y >= frame.film.height) {
    diagnostics.error({}, fmt::format("there is no pixel {}, {}", x, y),
                      fmt::format("0, 0 to {}, {}", frame.film.width - 1, frame.film.height - 1));
  }
  if (frame.integrator.from_lights) {
    diagnostics.error({}, "the paths of integrator 'ptracer' begin at the lights and belong to no pixel",
                      "another integrator");
  }
  if (frame.integrator.media && !tables.media.empty())
    diagnostics.error({}, "paths through media are not told vertex by vertex", "a scene without media");
  if (diagnostics.has_errors()) return diagnostics;

  const auto accel = scene.state().accel(accel_kind, frame.layers, worker_count(options.threads), diagnostics);
  if (!accel) return diagnostics;
  SceneView view = scene.state().view(frame, accel->view());
  view.sampler.seed += options.seed;
  view.volumetric = false;
  WaveArena arena(kMaxLanes);
  WaveMemory& memory = arena.memory();
  PathObserver path(view, *kernels);
  memory.observer = path.observer();
  WaveCounts counts;
  const WaveJob job{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 1, 1, sample, 1};
  kernels->trace_wave(view, job, memory, counts);
  PathTrace trace = path.take(memory);
  const std::vector<std::string>& ids = scene.tables().shape_ids;
  for (PathVertex& v : trace.vertices) {
    if (v.hit && v.shape < ids.size()) v.shape_id = ids[v.shape];
  }
  return {std::move(trace), std::move(diagnostics)};
}

}  // namespace norrsken
