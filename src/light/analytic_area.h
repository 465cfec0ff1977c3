// Model       A shape with a formula of its own that emits from its front, the same in all directions; the radiance may
//             be a texture.
// Measure     uniform over the area, told as pdf_sa
// Source      Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", 1996
// Departures  shapes without a way of sampling their area (see src/shape/shape.h) are lights that only rays find
#pragma once

#include "light/area_point.h"
#include "shape/models.h"

namespace norrsken::NORRSKEN_ISA {

struct AnalyticAreaLight {
  struct Stored {
    TextureWord texture;
    std::uint32_t analytic;  ///< the shape's index in `analytics`
  };

  struct Place {
    Affine world_from_local, local_from_world;
    UInt kinds;
    Float side;  ///< -1 for flipped normals
  };
  static inline Place load(const SceneView& scene, Light light, Mask active) {
    const UInt shape = gather_slot(scene.parameters, &Stored::analytic, light.parameters, active);
    const Mask flipped = gather(scene.analytics, &AnalyticRecord::flip_normals, shape, active) != 0u;
    return {gather(scene.analytics, &AnalyticRecord::place, &Placement::world_from_local, shape, active),
            gather(scene.analytics, &AnalyticRecord::place, &Placement::local_from_world, shape, active),
            gather(scene.analytics, &AnalyticRecord::kind, shape, active), select(flipped, Float(-1.0f), Float(1.0f))};
  }

  template <class Model>
  static NORRSKEN_INLINE Mask lanes_of(const SceneView& scene, AnalyticKind kind, const Place& place, Mask active) {
    const auto number = static_cast<std::uint32_t>(kind);
    const bool occurs = kCanBeSampled<Model> && (scene.analytic_kinds & (1u << number)) != 0;
    return occurs ? active & (place.kinds == UInt(number)) : Mask::none();
  }

  static NORRSKEN_INLINE Vec3f world_normal(const Place& place, const Vec3f& local) {
    return normalize(place.local_from_world.transposed(local)) * place.side;
  }

  __attribute__((noinline)) static LightSample sample(const SceneView& scene, Light light, Vec3f reference, Vec2f u,
                                                      Mask active) {
    return seen_from(reference, sample_area(scene, light, u, active), light.area);
  }

  __attribute__((noinline)) static EmittedRay emit(const SceneView& scene, Light light, Vec2f position, Vec2f direction,
                                                   Mask active) {
    return emit_from_surface(sample_area(scene, light, position, active), light.area, direction);
  }

  __attribute__((noinline)) static Float pdf_sa(const SceneView& scene, Light light, Vec3f reference, Vec3f direction,
                                                Float distance, Mask active) {
    const Place place = load(scene, light, active);
    const Vec3f local = place.local_from_world.point(fma(direction, distance, reference));
    Vec3f normal{0.0f, 0.0f, 1.0f};
    Mask sampled = Mask::none();
#define NORRSKEN_ANALYTIC(kind, Model)                                                                \
  if (const Mask of_kind = lanes_of<Model>(scene, AnalyticKind::kind, place, active); any(of_kind)) { \
    if constexpr (kCanBeSampled<Model>) {                                                             \
      normal = select(of_kind, surface_of<Model>(ElementReader{}, local).normal, normal);             \
      sampled |= of_kind;                                                                             \
    }                                                                                                 \
  }
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC
    const Float cosine = -dot(direction, world_normal(place, normal));
    return zero_unless(sampled, pdf_sa_from_pdf_area(1.0f / light.area, distance * distance, cosine));
  }

  static inline AreaPoint sample_area(const SceneView& scene, Light light, Vec2f u, Mask active) {
    const Place place = load(scene, light, active);
    const UInt texture = light_texture(scene, light.parameters, active);
    const Mask textured = active & (texture != 0u);
    const Vec3f zero{0.0f, 0.0f, 0.0f};
    LocalPoint local{zero, {0.0f, 0.0f, 1.0f}};
    TexturePoint on_texture{};
    Mask sampled = Mask::none();
#define NORRSKEN_ANALYTIC(kind, Model)                                                              \
  if (const Mask of_kind = lanes_of<Model>(scene, AnalyticKind::kind, place, active); any(of_kind)) \
    sample_kind<Model>(u, any(textured), of_kind, local, on_texture, sampled);
#include "lists/analytic_shape.def"
#undef NORRSKEN_ANALYTIC
    const Vec3f point = place.world_from_local.point(local.position);
    const Vec3f there = place.local_from_world.magnitude(point);
    const Float one(1.0f);
    // What rounding is relative to on a ray's way to the local space and back.
    const Float scale =
        largest(place.world_from_local.magnitude({max(there.x, one), max(there.y, one), max(there.z, one)}));
    const Color radiance =
        any(textured) ? select(textured, evaluate_texture(scene, texture, on_texture, textured), light.emission)
                      : light.emission;
    return {point, world_normal(place, local.normal), radiance, scale, sampled};
  }

 private:
  template <class Model>
  static NORRSKEN_INLINE void sample_kind(Vec2f u, bool needs_uv, Mask of_kind, LocalPoint& local,
                                          TexturePoint& on_texture, Mask& sampled) {
    if constexpr (kCanBeSampled<Model>) {
      const LocalPoint p = Model::sample(u);
      local = {select(of_kind, p.position, local.position), select(of_kind, p.normal, local.normal)};
      if (needs_uv) on_texture.uv = select(of_kind, Model::surface_at(p.position).uv, on_texture.uv);
      sampled |= of_kind;
    }
  }
};

}  // namespace norrsken::NORRSKEN_ISA
