// Rays against the scene, whichever way the scene is held. The choice is one for the whole scene.
#pragma once

#include "accel/bvh/of_queue.h"
#include "accel/embree.h"
#include "accel/moller_trumbore.h"
#include "accel/planes.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE const float* corner(const SceneView& scene, std::uint32_t triangle, std::uint32_t k) {
  return scene.positions + std::size_t{3} * scene.triangle_vertices[std::size_t{3} * triangle + k];
}

NORRSKEN_INLINE TriangleCrossing cross_triangle_of(const SceneView& scene, std::uint32_t i, const Vec3f& o,
                                                   const Vec3f& d) {
  return cross_triangle(corner(scene, i, 0), corner(scene, i, 1), corner(scene, i, 2), o, d);
}

NORRSKEN_INLINE void closest_by_moller_trumbore(const SceneView& scene, const Vec3f& o, const Vec3f& d,
                                                ClosestHit& hit) {
  for (std::uint32_t i = 0; i < scene.triangle_count; ++i) {
    const TriangleCrossing c = cross_triangle_of(scene, i, o, d);
    const Mask found = c.inside & (c.t > Float(0.0f)) & (c.t < hit.t);
    const UInt side = select(c.back, UInt(kBackSide), UInt(0u));
    hit.t = select(found, c.t, hit.t);
    hit.primitive_side = select(found, side | UInt(i), hit.primitive_side);
  }
  for (std::uint32_t i = 0; i < scene.accel.sphere_count; ++i) closest_sphere(scene.accel.spheres[i], o, d, hit);
}

NORRSKEN_INLINE Mask occluded_by_moller_trumbore(const SceneView& scene, const Vec3f& o, const Vec3f& d, Float t_max) {
  Mask occluded = Mask::none();
  for (std::uint32_t i = 0; i < scene.triangle_count; ++i) {
    const TriangleCrossing c = cross_triangle_of(scene, i, o, d);
    occluded |= c.inside & (c.t > Float(0.0f)) & (c.t < t_max);
  }
  for (std::uint32_t i = 0; i < scene.accel.sphere_count; ++i) {
    occluded |= occluded_by_sphere(scene.accel.spheres[i], o, d, t_max);
  }
  return occluded;
}

/// The closest hit of unit-length rays; `t` is infinite where there is none.
NORRSKEN_INLINE ClosestHit intersect_closest_lanes(const SceneView& scene, bool coherent, const Vec3f& o,
                                                   const Vec3f& d, Mask active) {
  ClosestHit hit = no_hit();
  switch (scene.accel.kind) {
    case AccelKind::planes:
      closest_in_planes(scene.accel, scene.accel.all, scene.accel.sphere_count, o, d, hit);
      break;
    case AccelKind::moller_trumbore:
      closest_by_moller_trumbore(scene, o, d, hit);
      break;
    case AccelKind::bvh:
      return closest_in_bvh(scene.accel, copied(o), copied(d), active);
    case AccelKind::embree:
      return closest_in_embree(scene, coherent, copied(o), copied(d), active);
  }
  return hit;
}

/// Whether anything lies between the origin and `t_max`.
NORRSKEN_INLINE Mask occluded_lanes(const SceneView& scene, const Vec3f& o, const Vec3f& d, Float t_max, Mask active) {
  switch (scene.accel.kind) {
    case AccelKind::planes:
      return active & occluded_in_planes(scene.accel, o, d, t_max);
    case AccelKind::moller_trumbore:
      return active & occluded_by_moller_trumbore(scene, o, d, t_max);
    case AccelKind::bvh:
      return occluded_in_bvh(scene.accel, copied(o), copied(d), t_max, active);
    case AccelKind::embree:
      return occluded_in_embree(scene, copied(o), copied(d), t_max, active);
  }
  return active;
}

/// The closest hits of a queue's rays, asked for in their order, none left out, register by register: what takes rays by the
/// wave has them by then.
class ClosestOfQueue {
 public:
  ClosestOfQueue(const SceneView& scene, bool coherent, const RayFields& rays, std::uint32_t count)
      : scene_(scene), coherent_(coherent), rays_(rays), count_(count) {}
  ClosestOfQueue(const SceneView& scene, bool coherent, const Queue<stored::Ray>& rays)
      : ClosestOfQueue(scene, coherent, RayFields(rays), rays.count) {}

  /// Of the rays from `i` on, whose origins and directions are `o` and `d`.
  NORRSKEN_INLINE ClosestHit at(std::uint32_t i, const Vec3f& o, const Vec3f& d, Mask active) {
    if (scene_.accel.kind != AccelKind::bvh) return intersect_closest_lanes(scene_, coherent_, o, d, active);
    const std::uint32_t place = i % kRaysAtATime;
    if (place == 0) ask_from(i);
    return {load(t_ + place), load_uint(reinterpret_cast<const float*>(primitive_side_) + place)};
  }

 private:
  void ask_from(std::uint32_t i) {
    const std::uint32_t rest = count_ - i;
    const std::uint32_t count = rest < kRaysAtATime ? rest : kRaysAtATime;
    closest_in_bvh(scene_.accel, rays_.from(i), count, t_, primitive_side_);
    fetch_triangles(count);
  }

  /// Asks memory for what shading will want of the triangles: one ray hits here, the next there.
  void fetch_triangles(std::uint32_t count) const {
    constexpr std::uint32_t kAhead = 16;  // what the vertices are found by comes first
    for (std::uint32_t k = 0; k < count + kAhead; ++k) {
      if (k < count && is_triangle(k)) {
        const std::uint32_t triangle = primitive_side_[k] & kPrimitiveMask;
        __builtin_prefetch(scene_.triangle_vertices + std::size_t{3} * triangle);
        __builtin_prefetch(scene_.surfaces + triangle);
      }
      if (k < kAhead || !is_triangle(k - kAhead)) continue;
      const std::uint32_t triangle = primitive_side_[k - kAhead] & kPrimitiveMask;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::size_t vertex = std::size_t{3} * scene_.triangle_vertices[std::size_t{3} * triangle + c];
        __builtin_prefetch(scene_.positions + vertex);
        if (scene_.any_smooth) __builtin_prefetch(scene_.normals + vertex);
      }
    }
  }
  bool is_triangle(std::uint32_t k) const {
    return t_[k] < kInfinity && (primitive_side_[k] & kPrimitiveMask) < scene_.triangle_count;
  }

  const SceneView& scene_;
  bool coherent_;
  RayFields rays_;
  std::uint32_t count_;
  alignas(64) float t_[kRaysAtATime];
  alignas(64) std::uint32_t primitive_side_[kRaysAtATime];
};

/// The same for whether anything lies between the origin and `t_max`.
class OccludedOfQueue {
 public:
  OccludedOfQueue(const SceneView& scene, const RayFields& rays, const float* t_max, std::uint32_t count)
      : scene_(scene), rays_(rays), t_max_(t_max), count_(count) {}
  OccludedOfQueue(const SceneView& scene, const Queue<stored::ShadowRay>& rays)
      : OccludedOfQueue(scene, RayFields(rays), rays.field(&stored::ShadowRay::t_max), rays.count) {}
  OccludedOfQueue(const SceneView& scene, const Queue<stored::Connection>& rays)
      : OccludedOfQueue(scene, RayFields(rays), rays.field(&stored::Connection::ray, &stored::ShadowRay::t_max),
                        rays.count) {}

  NORRSKEN_INLINE Mask at(std::uint32_t i, const Vec3f& o, const Vec3f& d, Float t_max, Mask active) {
    if (scene_.accel.kind != AccelKind::bvh) return occluded_lanes(scene_, o, d, t_max, active);
    const std::uint32_t place = i % kRaysAtATime;
    if (place == 0) ask_from(i);
    return active & (t_max > Float(0.0f)) & (load(t_ + place) < Float(0.0f));
  }

 private:
  void ask_from(std::uint32_t i) {
    const std::uint32_t rest = count_ - i, count = rest < kRaysAtATime ? rest : kRaysAtATime;
    for (std::uint32_t k = 0; k < count; k += kLanes) store(t_ + k, load(t_max_ + i + k));
    occluded_in_bvh(scene_.accel, rays_.from(i), count, t_);
  }

  const SceneView& scene_;
  RayFields rays_;
  const float* t_max_;
  std::uint32_t count_;
  alignas(64) float t_[kRaysAtATime];
};

}  // namespace norrsken::NORRSKEN_ISA
