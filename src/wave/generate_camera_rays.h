// Stage: the wave's job -> slots and RAYS.
#pragma once

#include "camera/perspective.h"
#include "sampler/sampler.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE SampleKey load_sample_key(const Queue& slots, UInt slot, Mask active) {
  return {gather_uint(slots.field(kSlotKey), slot, active), gather_uint(slots.field(kSlotIndex), slot, active)};
}

inline void generate_camera_rays(const SceneView& scene, const WaveJob& job, Queue& slots, Queue& rays) {
  const Sampler sampler{scene.sampler.kind};
  const std::uint32_t pixels = job.pixel_count(), stride = job.pixel_stride();
  const Float inverse_width(1.0f / static_cast<float>(job.width));
  slots.count = job.slot_count();
  rays.count = 0;
  for (std::uint32_t s = 0; s < job.sample_count; ++s) {
    for (std::uint32_t first = 0; first < stride; first += kLanes) {
      const Mask active = first_lanes(first < pixels ? pixels - first : 0u);
      const std::uint32_t slot_base = s * stride + first;
      const UInt local = UInt(first) + lane_index();
      const UInt row = to_uint((to_float(local) + Float(0.5f)) * inverse_width);
      const UInt x = UInt(job.x0) + local - row * UInt(job.width), y = UInt(job.y0) + row;
      const UInt pixel = y * UInt(static_cast<std::uint32_t>(scene.film.width)) + x;
      const SampleKey key = make_sample_key(scene.sampler.kind, scene.sampler.seed, pixel, job.first_sample + s);

      for (std::uint32_t channel = kSlotRed; channel <= kSlotBlue; ++channel) {
        store(slots.field(channel) + slot_base, Float(0.0f));
      }
      store(slots.field(kSlotKey) + slot_base, key.key);
      store(slots.field(kSlotIndex) + slot_base, key.index);

      // The box filter, sampled: a point of the pixel.
      const Vec2f jitter = sampler.sample_2d(key, camera_dimension::kFilm);
      const CameraRay camera_ray = sample_perspective(scene.camera, to_float(x) + jitter.x, to_float(y) + jitter.y);
      const Float one(1.0f);
      push(rays,
           Ray{camera_ray.origin, camera_ray.direction, {one, one, one}, Float(0.0f), UInt(slot_base) + lane_index()},
           active);
    }
  }
}

}  // namespace norrsken::NORRSKEN_ISA
