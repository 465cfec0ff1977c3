// Stage: first HITS -> features of their slots, those that the scene's view wants.
#pragma once

#include "camera/camera.h"
#include "wave/perturbed_frame.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// Stores a register's values of one feature to the slots of its active lanes.
NORRSKEN_INLINE void store_feature(Slots& slots, std::uint32_t feature, UInt slot, Float value, Mask active) {
  alignas(64) float lanes[kLanes], index[kLanes];
  store(index, slot);
  store(lanes, value);
  float* field = slots.field(&stored::Slot::features, feature);
  for (std::uint32_t rest = to_bits(active); rest != 0; rest &= rest - 1) {
    const int lane = __builtin_ctz(rest);
    std::uint32_t s;
    __builtin_memcpy(&s, &index[lane], sizeof s);
    field[s] = lanes[lane];
  }
}

template <class Model>
inline void shade_features(const SceneView& scene, const Hits& hits, Slots& slots) {
  for (std::uint32_t i = 0; i < hits.count; i += kLanes) {
    const Mask active = first_lanes(hits.count - i);
    const Hit hit = load<Hit>(scene, hits, i);
    SurfacePoint surface = make_surface_point(scene, hit, active);
    perturb_frame(scene, hit, surface, active);
    const auto bsdf = Model::load(parameter_reader(scene, hit, surface, active));
    const Color albedo = Model::albedo(bsdf);
    const UInt shape = shape_of(scene, hit.primitive, active);
    const UInt first_primitive = gather(scene.shapes, &ShapeRecord::first_primitive, shape, active);
    const Float along_axis = dot(hit.ray.direction, broadcast(scene.camera.forward));
    const Vec3f facing = surface.frame.n, p = surface.position;
    const Vec3f geometric = surface.normal, shading = facing * surface.side;
    const Float values[kFeatureCount] = {
        fma(hit.t, along_axis, Float(scene.camera.near_clip)),
        facing.x,
        facing.y,
        facing.z,
        albedo.r,
        albedo.g,
        albedo.b,
        to_float(shape + 1u),
        1.0f,
        hit.t + distance_to_near_plane(scene.camera, hit.ray.direction),
        p.x,
        p.y,
        p.z,
        surface.texture.uv.x,
        surface.texture.uv.y,
        geometric.x,
        geometric.y,
        geometric.z,
        shading.x,
        shading.y,
        shading.z,
        surface.dp_du.x,
        surface.dp_du.y,
        surface.dp_du.z,
        surface.dp_dv.x,
        surface.dp_dv.y,
        surface.dp_dv.z,
        to_float(hit.primitive - first_primitive),
    };
    for (std::uint32_t rest = scene.features; rest != 0; rest &= rest - 1) {
      const auto feature = static_cast<std::uint32_t>(__builtin_ctz(rest));
      store_feature(slots, feature, hit.ray.slot, values[feature], active);
    }
  }
}

}  // namespace norrsken::NORRSKEN_ISA
