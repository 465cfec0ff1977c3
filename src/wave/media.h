// What rays know of the media that they run through.
//
// Colours: extinction may differ by channel, and a distance is drawn for one of them. That is the one-sample model of
// multiple importance sampling with the balance heuristic over the channels (Veach 1997, section 9.2.4), each with its
// share of the throughput: what a path carries in all channels together then never grows.
#pragma once

#include "math/special.h"
#include "medium/volume.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

template <class T>
NORRSKEN_INLINE auto gather_medium(const SceneView& scene, T MediumRecord::*member, UInt medium, Mask active) {
  return gather(scene.media, member, medium, active);
}
NORRSKEN_INLINE Color gather_medium_color(const SceneView& scene, float (MediumRecord::*member)[3], UInt medium,
                                          Mask active) {
  const Vec3f v = gather(scene.media, member, medium, active);
  return {v.x, v.y, v.z};
}

NORRSKEN_INLINE Mask is_grid(const SceneView& scene, UInt medium, Mask active) {
  if (!scene.any_grid_medium) return Mask::none();
  return active & (gather_medium(scene, &MediumRecord::sigma_volume, medium, active) != kNone);
}

/// Which share of all the light each channel has; alike where there is none.
NORRSKEN_INLINE Color shares(const Color& throughput) {
  const Float sum = sum_of(throughput);
  const Mask some = sum > 0.0f;
  return select(some, throughput * (1.0f / select(some, sum, 1.0f)), grey(1.0f / 3.0f));
}

NORRSKEN_INLINE Float sum_of_products(const Color& a, const Color& b) {
  return fma(a.r, b.r, fma(a.g, b.g, a.b * b.b));
}

/// Of a homogeneous medium over a distance, which may be infinite.
NORRSKEN_INLINE Float transmittance(Float sigma_t, Float distance) {
  return select(sigma_t > 0.0f, exp(-(sigma_t * distance)), 1.0f);
}
NORRSKEN_INLINE Color transmittance(const Color& sigma_t, Float distance) {
  return {transmittance(sigma_t.r, distance), transmittance(sigma_t.g, distance), transmittance(sigma_t.b, distance)};
}

/// The optical depth at which the next collision comes.
NORRSKEN_INLINE Float collision_depth(Float u) { return -log(1.0f - u); }

NORRSKEN_INLINE Color albedo_of(const SceneView& scene, UInt medium, const Vec3f& position, Mask active) {
  Color albedo = gather_medium_color(scene, &MediumRecord::albedo, medium, active);
  const UInt volume = gather_medium(scene, &MediumRecord::albedo_volume, medium, active);
  const Mask varies = active & (volume != kNone);
  if (none(varies)) return albedo;
  const Color found = evaluate_volume(scene, volume, copied(position), varies);
  const auto share = [](Float a) { return min(max(a, 0.0f), 1.0f); };
  return select(varies, Color{share(found.r), share(found.g), share(found.b)}, albedo);
}

struct Flight {
  Mask scattered;
  Float t;  ///< where
  Color throughput;
};

/// Through a homogeneous medium, up to `distance`; where nothing `scatters` light is only absorbed on the way.
NORRSKEN_INLINE Flight fly(const SceneView& scene, UInt medium, const Ray& ray, Float distance, bool scatters, Float u,
                           Mask active) {
  const Color sigma_t = gather_medium_color(scene, &MediumRecord::sigma_t, medium, active);
  const Mask may_scatter = active & (gather_medium(scene, &MediumRecord::scatters, medium, active) != 0u);
  if (!scatters || none(may_scatter))
    return {Mask::none(), distance, ray.throughput * transmittance(sigma_t, distance)};

  const Color share = shares(ray.throughput);
  const Mask red = u < share.r, green = u < share.r + share.g;
  const Float chosen_sigma = select(red, sigma_t.r, select(green, sigma_t.g, sigma_t.b));
  const Float before = select(red, 0.0f, select(green, share.r, share.r + share.g));
  const Float of_channel = select(red, share.r, select(green, share.g, share.b));
  const Float rescaled = min(max((u - before) / of_channel, 0.0f), 0x1.fffffep-1f);
  const Float t = select(chosen_sigma > 0.0f, collision_depth(rescaled) / chosen_sigma, kInfinity);

  const Mask scattered = may_scatter & (t < distance);
  const Float end = select(scattered, t, distance);
  const Color arrives = transmittance(sigma_t, end);
  const Color albedo = albedo_of(scene, medium, fma(ray.direction, zero_unless(scattered, end), ray.origin), scattered);
  const Color collides = arrives * sigma_t;
  const Float density = select(scattered, sum_of_products(share, collides), sum_of_products(share, arrives));
  const Color weight = select(scattered, collides * albedo, arrives) * (1.0f / density);
  // Media that only absorb share their registers with those that scatter.
  const Color after = select(may_scatter, ray.throughput * weight, ray.throughput * arrives);
  return {scattered, end, after};
}

}  // namespace norrsken::NORRSKEN_ISA
