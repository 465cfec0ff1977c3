// Records of paths in lanes, and how they go in and out of queues.
#pragma once

#include "accel/hit.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// A ray on its way, with the path that it continues.
struct Ray {
  Vec3f origin, direction;  ///< direction is a unit vector
  Vec3f throughput;
  Float pdf_sa;  ///< density that sampled the direction; 0 if no light sampling competes with it
  UInt slot;
  Float eta2 = Float(1.0f);  ///< squared index of refraction where it is over that where the path began
};

/// A ray that hit something.
struct Hit {
  Ray ray;
  Float t;
  UInt primitive;
  UInt material;              ///< the word of the side that was hit
  UInt instance;              ///< that it was hit in, or kNone
  UInt maps[kMostMaps] = {};  ///< the words of the bump and normal maps there, from the outside in; the others are 0
};

NORRSKEN_INLINE void end_at(Hit& hit, const ClosestHit& closest) {
  hit.t = closest.t;
  hit.primitive = closest.primitive_side & UInt(kPrimitiveMask);
  hit.instance = closest.instance;
}

/// A ray that carries `contribution` to its slot unless something is within `t_max`.
struct ShadowRay {
  Vec3f origin, direction;
  Float t_max;
  Vec3f contribution;
  UInt slot;
};

NORRSKEN_INLINE Vec3f load3(const Queue& q, std::uint32_t first_field, std::uint32_t i) {
  return {load(q.field(first_field) + i), load(q.field(first_field + 1) + i), load(q.field(first_field + 2) + i)};
}
NORRSKEN_INLINE void compress_store3(const Queue& q, std::uint32_t first_field, std::uint32_t i, const Vec3f& v,
                                     const Compaction& c) {
  compress_store(q.field(first_field) + i, v.x, c);
  compress_store(q.field(first_field + 1) + i, v.y, c);
  compress_store(q.field(first_field + 2) + i, v.z, c);
}

/// `Scene`, here and below: SceneView or PlainScene.
template <class Scene>
NORRSKEN_INLINE Float load_eta2(const Scene& scene, const Queue& q, std::uint32_t i) {
  return scene.refracts ? load(q.field(kRayEta2) + i) : Float(1.0f);
}
template <class Scene>
NORRSKEN_INLINE Ray load_ray(const Scene& scene, const Queue& q, std::uint32_t i) {
  return {load3(q, kRayOriginX, i),   load3(q, kRayDirectionX, i),      load3(q, kRayThroughputRed, i),
          load(q.field(kRayPdf) + i), load_uint(q.field(kRaySlot) + i), load_eta2(scene, q, i)};
}
template <class Scene>
NORRSKEN_INLINE void store_ray_fields(const Scene& scene, const Queue& q, const Ray& r, const Compaction& c) {
  compress_store3(q, kRayOriginX, q.count, r.origin, c);
  compress_store3(q, kRayDirectionX, q.count, r.direction, c);
  compress_store3(q, kRayThroughputRed, q.count, r.throughput, c);
  compress_store(q.field(kRayPdf) + q.count, r.pdf_sa, c);
  compress_store(q.field(kRaySlot) + q.count, r.slot, c);
  if (scene.refracts) compress_store(q.field(kRayEta2) + q.count, r.eta2, c);
}
template <class Scene>
NORRSKEN_INLINE void push(const Scene& scene, Queue& q, const Ray& r, Mask m) {
  const Compaction c = make_compaction(m);
  store_ray_fields(scene, q, r, c);
  q.count += c.count;
}

template <class Scene>
NORRSKEN_INLINE Hit load_hit(const Scene& scene, const Queue& q, std::uint32_t i) {
  Hit hit{load_ray(scene, q, i), load(q.field(kHitDistance) + i), load_uint(q.field(kHitPrimitive) + i),
          load_uint(q.field(kHitMaterial) + i),
          scene.instance_count > 0 ? load_uint(q.field(kHitInstance) + i) : UInt(kNone)};
  if (scene.any_resolved) {
    for (std::uint32_t k = 0; k < kMostMaps; ++k) hit.maps[k] = load_uint(q.field(kHitMaps + k) + i);
  }
  return hit;
}
NORRSKEN_INLINE void push(const SceneView& scene, Queue& q, const Hit& h, Mask m) {
  const Compaction c = make_compaction(m);
  store_ray_fields(scene, q, h.ray, c);
  compress_store(q.field(kHitDistance) + q.count, h.t, c);
  compress_store(q.field(kHitPrimitive) + q.count, h.primitive, c);
  compress_store(q.field(kHitMaterial) + q.count, h.material, c);
  if (scene.instance_count > 0) compress_store(q.field(kHitInstance) + q.count, h.instance, c);
  if (scene.any_resolved) {
    for (std::uint32_t k = 0; k < kMostMaps; ++k) compress_store(q.field(kHitMaps + k) + q.count, h.maps[k], c);
  }
  q.count += c.count;
}

NORRSKEN_INLINE ShadowRay load_shadow_ray(const Queue& q, std::uint32_t i) {
  return {load3(q, kShadowOriginX, i), load3(q, kShadowDirectionX, i), load(q.field(kShadowDistance) + i),
          load3(q, kShadowRed, i), load_uint(q.field(kShadowSlot) + i)};
}
NORRSKEN_INLINE void push(Queue& q, const ShadowRay& r, Mask m) {
  const Compaction c = make_compaction(m);
  compress_store3(q, kShadowOriginX, q.count, r.origin, c);
  compress_store3(q, kShadowDirectionX, q.count, r.direction, c);
  compress_store(q.field(kShadowDistance) + q.count, r.t_max, c);
  compress_store3(q, kShadowRed, q.count, r.contribution, c);
  compress_store(q.field(kShadowSlot) + q.count, r.slot, c);
  q.count += c.count;
}

/// Adds to the slots' radiance. One slot may occur in several lanes (several shadow rays of one hit), so the lanes
/// go one after the other; the order is the queue's, whatever the register width.
NORRSKEN_INLINE void add_radiance(const Queue& slots, UInt slot, const Vec3f& value, Mask m) {
  alignas(64) float red[kLanes], green[kLanes], blue[kLanes], index[kLanes];
  store(red, value.x), store(green, value.y), store(blue, value.z), store(index, slot);
  for (std::uint32_t rest = to_bits(m); rest != 0; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    std::uint32_t s;
    __builtin_memcpy(&s, &index[i], sizeof s);
    slots.field(kSlotRed)[s] += red[i];
    slots.field(kSlotGreen)[s] += green[i];
    slots.field(kSlotBlue)[s] += blue[i];
  }
}

NORRSKEN_INLINE Mask is_sound(const Ray& ray) {
  const Vec3f& t = ray.throughput;
  return is_ray(ray.origin, ray.direction) & (t.x + t.y + t.z < Float(kInfinity));
}

/// Adds NaN to the slots, which is what the film drops and counts. Not inlined: no good scene needs it.
__attribute__((noinline)) inline void give_up(const Queue& slots, UInt slot, Mask spoilt) {
  const Float nan(__builtin_nanf(""));
  add_radiance(slots, slot, {nan, nan, nan}, spoilt);
}

/// Gives up the samples of lanes that are not `sound`. Returns the lanes that are left.
NORRSKEN_INLINE Mask keep_sound(Mask sound, UInt slot, const Queue& slots, Mask active) {
  const Mask spoilt = active & !sound;
  if (any(spoilt)) give_up(slots, slot, spoilt);
  return active & sound;
}

}  // namespace norrsken::NORRSKEN_ISA
