// Stage: the wave's job -> slots and RAYS.
#pragma once

#include "camera/models.h"
#include "rfilter/filter.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

template <class Camera, class Filter>
inline void generate_rays_of(const SceneView& scene, const Filter& filter, const WaveJob& job, Slots& slots,
                             Rays& rays) {
  const Sampler sampler{scene.sampler.kind};
  const FilmSettings& film = scene.film;
  const std::uint32_t pixels = job.pixel_count(), stride = job.pixel_stride();
  const UInt crop_x(static_cast<std::uint32_t>(film.crop_x)), crop_y(static_cast<std::uint32_t>(film.crop_y));
  const Float inverse_width(1.0f / static_cast<float>(job.width));
  slots.count = job.slot_count();
  rays.count = 0;
  for (std::uint32_t s = 0; s < job.sample_count; ++s) {
    for (std::uint32_t first = 0; first < stride; first += kLanes) {
      const Mask active = first_lanes(first < pixels ? pixels - first : 0u);
      const std::uint32_t slot_base = s * stride + first;
      const UInt local = UInt(first) + lane_index();
      const UInt row = to_uint((to_float(local) + 0.5f) * inverse_width);
      const UInt x = UInt(job.x0) + local - row * UInt(job.width), y = UInt(job.y0) + row;
      // Counted over the whole film: a crop window shows the same samples as the film that it is cut from.
      const UInt film_x = x + crop_x, film_y = y + crop_y;
      const UInt pixel = film_y * UInt(static_cast<std::uint32_t>(film.full_width)) + film_x;
      const SampleKey key = make_sample_key(scene.sampler.kind, scene.sampler.seed, pixel, job.first_sample + s);

      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        store(slots.field(&stored::Slot::radiance, channel) + slot_base, Float(0.0f));
      }
      store_sample_key(slots, slot_base, key);

      const FilterSample in_pixel = filter.sample(x, y, sampler.sample_2d(key, camera_dimension::kFilm), active);
      if (Filter::kWeighted) store(slots.field(&stored::Slot::weight) + slot_base, in_pixel.weight);
      Vec2f lens{0.0f, 0.0f};
      if (Camera::kUsesLens) lens = sampler.sample_2d(key, camera_dimension::kLens);
      const CameraRay camera_ray =
          Camera::sample(scene.camera, to_float(film_x) + in_pixel.dx, to_float(film_y) + in_pixel.dy, lens);
      push(scene, rays,
           Ray{.origin = camera_ray.origin,
               .direction = camera_ray.direction,
               .throughput = white(),
               .pdf_sa = 0.0f,
               .slot = UInt(slot_base) + lane_index(),
               .medium = UInt(scene.camera.medium)},
           active);
    }
  }
}

/// The camera and the filter are the same for a whole render.
inline void generate_camera_rays(const SceneView& scene, const WaveJob& job, Slots& slots, Rays& rays) {
  const bool box = scene.film.filter.kind == FilterKind::box;
  switch (scene.camera.kind) {
#define NORRSKEN_CAMERA(kind, Model)                                            \
  case CameraKind::kind:                                                        \
    if (box) {                                                                  \
      generate_rays_of<Model>(scene, BoxFilter{}, job, slots, rays);            \
    } else {                                                                    \
      generate_rays_of<Model>(scene, TabulatedFilter(scene), job, slots, rays); \
    }                                                                           \
    break;
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
    case CameraKind::count:
      break;
  }
}

}  // namespace norrsken::NORRSKEN_ISA
