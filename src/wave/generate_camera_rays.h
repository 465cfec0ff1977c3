// Stage: the wave's job -> slots and RAYS.
#pragma once

#include "camera/models.h"
#include "rfilter/filter.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// The part of a film that a camera's picture fills: all of it, or of a batch some columns.
struct FilmColumns {
  float begin, end;
};

/// The ray of a film position in pixels, counted from the corner of the camera's own part of the film.
template <class Camera>
NORRSKEN_INLINE CameraRay camera_ray(const SceneView& scene, const CameraRecord& camera, const FilmColumns& columns,
                                     Float px, Float py, Vec2f lens, Mask active) {
  if constexpr (requires { Camera::kWeight; }) {
    const auto share = [](Float p, float size) { return min(max(p * Float(1.0f / size), 0.0f), 1.0f - 0x1p-24f); };
    const Vec2f place{share(px, columns.end - columns.begin), share(py, static_cast<float>(scene.film.full_height))};
    return Camera::sample(scene, camera, place, lens, active);
  } else {
    return Camera::sample(camera, px, py, lens);
  }
}

template <class Camera>
constexpr bool uses_lens() {
  if constexpr (requires { Camera::kWeight; }) {
    return true;
  } else {
    return Camera::kUsesLens;
  }
}

template <class Camera>
constexpr float weight_of_rays() {
  if constexpr (requires { Camera::kWeight; }) {
    return Camera::kWeight;
  } else {
    return 1;
  }
}

template <class Camera, class Filter>
inline void generate_rays_of(const SceneView& scene, const CameraRecord& camera, const FilmColumns& columns,
                             const Filter& filter, const WaveJob& job, Slots& slots, Rays& rays) {
  const Sampler sampler{scene.sampler.kind};
  const FilmSettings& film = scene.film;
  const std::uint32_t pixels = job.pixel_count(), stride = job.pixel_stride();
  const UInt crop_x(static_cast<std::uint32_t>(film.crop_x)), crop_y(static_cast<std::uint32_t>(film.crop_y));
  const Float inverse_width(1.0f / static_cast<float>(job.width));
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
      if (uses_lens<Camera>()) lens = sampler.sample_2d(key, camera_dimension::kLens);
      const Float column = to_float(film_x);
      const Mask seen = active & (column >= columns.begin) & (column < columns.end);
      const CameraRay ray = camera_ray<Camera>(scene, camera, columns, column + in_pixel.dx - columns.begin,
                                               to_float(film_y) + in_pixel.dy, lens, seen);
      push(scene, rays,
           Ray{.origin = ray.origin,
               .direction = ray.direction,
               .throughput = grey(weight_of_rays<Camera>()),
               .pdf_sa = 0.0f,
               .slot = UInt(slot_base) + lane_index(),
               .medium = UInt(camera.medium)},
           seen);
    }
  }
}

template <class Camera>
inline void generate_rays_of(const SceneView& scene, const CameraRecord& camera, const FilmColumns& columns,
                             const WaveJob& job, Slots& slots, Rays& rays) {
  if (scene.film.filter.kind == FilterKind::box) {
    generate_rays_of<Camera>(scene, camera, columns, BoxFilter{}, job, slots, rays);
  } else {
    generate_rays_of<Camera>(scene, camera, columns, TabulatedFilter(scene), job, slots, rays);
  }
}

inline void generate_rays_from(const SceneView& scene, const CameraRecord& camera, const FilmColumns& columns,
                               const WaveJob& job, Slots& slots, Rays& rays) {
  switch (camera.kind) {
#define NORRSKEN_SENSOR(kind, Model)                                   \
  case CameraKind::kind:                                               \
    generate_rays_of<Model>(scene, camera, columns, job, slots, rays); \
    break;
#define NORRSKEN_CAMERA NORRSKEN_SENSOR
#define NORRSKEN_METER NORRSKEN_SENSOR
#include "lists/camera.def"
#include "lists/meter.def"
#undef NORRSKEN_CAMERA
#undef NORRSKEN_METER
#undef NORRSKEN_SENSOR
    default:
      break;
  }
}

/// The camera is the same for a whole render, or for the columns of a batch; the filter is.
inline void generate_camera_rays(const SceneView& scene, const WaveJob& job, Slots& slots, Rays& rays) {
  slots.count = job.slot_count();
  rays.count = 0;
  const float width = static_cast<float>(scene.film.full_width);
  if (scene.batch_count == 0) return generate_rays_from(scene, scene.camera, {0, width}, job, slots, rays);
  const float each = width / static_cast<float>(scene.batch_count);
  const float first = static_cast<float>(job.x0) + static_cast<float>(scene.film.crop_x);
  for (std::uint32_t i = 0; i < scene.batch_count; ++i) {
    const FilmColumns columns{each * static_cast<float>(i), each * static_cast<float>(i + 1)};
    if (columns.end <= first || columns.begin >= first + static_cast<float>(job.width)) continue;
    generate_rays_from(scene, scene.batch[i], columns, job, slots, rays);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
