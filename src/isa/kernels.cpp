// All kernels, compiled once per instruction set: the build sets NORRSKEN_ISA, NORRSKEN_LANES and the compiler's flags.
#include "isa/entry.h"
#include "isa/ray_arrays.h"
#include "wave/schedule.h"
#include "wave/trace_media.h"
#include "wave/trace_particles.h"

namespace norrsken::NORRSKEN_ISA {
namespace {

void occluded_rays(const SceneView& scene, const RayArrays& arrays, const float* t_max, std::uint8_t* occluded) {
  const RayFields rays = fields_of(arrays);
  OccludedOfQueue hidden(scene, rays, t_max, arrays.count);
  for (std::uint32_t i = 0; i < arrays.count; i += kLanes) {
    const Mask active = first_lanes(arrays.count - i);
    const std::uint32_t lanes =
        to_bits(hidden.at(i, rays.load_origin(i), rays.load_direction(i), load(t_max + i), active));
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(kLanes) && i + k < arrays.count; ++k) {
      occluded[i + k] = static_cast<std::uint8_t>((lanes >> k) & 1u);
    }
  }
}

void trace_any_wave(const SceneView& scene, const WaveJob& job, WaveMemory& memory, WaveCounts& counts) {
  scene.volumetric ? trace_media(scene, job, memory, counts) : trace_wave(scene, job, memory, counts);
}

}  // namespace

extern const KernelEntry kEntry;
const KernelEntry kEntry = {
    .name = NORRSKEN_ISA_NAME,
    .lanes = kLanes,
    .trace_wave = trace_any_wave,
    .trace_features = trace_features,
    .trace_particles = trace_particles,
    .accumulate_film = accumulate_film,
    .accumulate_features = accumulate_features,
    .occluded_rays = occluded_rays,
};

}  // namespace norrsken::NORRSKEN_ISA
