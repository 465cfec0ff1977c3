// Stage: first HITS -> feature layers of their slots (distance, shading normal, albedo, shape).
#pragma once

#include "wave/surface.h"

namespace norrsken::NORRSKEN_ISA {

template <class Model>
inline void shade_features(const SceneView& scene, const Queue& hits, Queue& slots) {
  for (std::uint32_t i = 0; i < hits.count; i += kLanes) {
    const Mask active = first_lanes(hits.count - i);
    const Hit hit = load_hit(scene, hits, i);
    const SurfacePoint surface = make_surface_point(scene, hit, active);
    const auto bsdf = Model::load(parameter_reader(scene, hit, surface, active));
    const Vec3f albedo = Model::albedo(bsdf);
    const UInt shape = gather_uint(surface_floats(scene) + 7, record_index(hit.primitive), active);
    const Vec3f along = hit.ray.direction * hit.t;
    const Float depth = dot(along, broadcast(scene.camera.forward)) + Float(scene.camera.near_clip);
    const Float values[] = {depth,    surface.frame.n.x, surface.frame.n.y, surface.frame.n.z,
                            albedo.x, albedo.y,          albedo.z,          to_float(shape + UInt(1u))};
    alignas(64) float lanes[kLanes], slot[kLanes];
    store(slot, hit.ray.slot);
    for (std::uint32_t k = 0; k < 8; ++k) {
      store(lanes, values[k]);
      for (std::uint32_t rest = to_bits(active); rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        std::uint32_t s;
        __builtin_memcpy(&s, &slot[lane], sizeof s);
        slots.field(kSlotDepth + k)[s] = lanes[lane];
      }
    }
  }
}

}  // namespace norrsken::NORRSKEN_ISA
