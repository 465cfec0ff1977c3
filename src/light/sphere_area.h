// Model       A sphere that emits from its outside, the same in all directions; the radiance may be a texture.
// Measure     pdf_sa: uniform over the cone of directions in which the sphere is seen; for a flipped sphere, which
//             shines inwards, uniform over the area
// Source      Wang 1992; Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.2.4
// Departures  1 - cos of the cone is computed without cancellation, so small far spheres stay exact
#pragma once

#include "light/area_point.h"
#include "shape/sphere.h"

namespace norrsken::NORRSKEN_ISA {

/// Of textured ones.
struct SphereAreaStored {
  TextureWord texture;
  std::uint32_t shape;
};

/// The radiance of textured lanes. Not inlined: few scenes need it.
__attribute__((noinline)) inline Color sphere_texture(const SceneView& scene, UInt parameters, Color emission,
                                                      UInt texture, Vec3f normal, Mask textured) {
  const UInt shape = gather_slot(scene.parameters, &SphereAreaStored::shape, parameters, textured);
  const Vec2f uv = sphere_uv(gather_sphere_rotation(scene, shape, textured).local(normal));
  return select(textured, evaluate_texture(scene, texture, {uv, {}, shape, {}}, textured), emission);
}

struct SphereAreaLight {
  /// 1 - cos of the cone's half angle; > 0 only outside of the sphere.
  static NORRSKEN_INLINE Float one_minus_cos(Float sin2) { return sin2 / (1.0f + sqrt(max(1.0f - sin2, 0.0f))); }

  /// Where the cone is sampled. The sphere's own surface is not, wherever rounding puts a point of it: it would light
  /// itself.
  static NORRSKEN_INLINE Mask is_outside(const Light& light, Float distance2) {
    const Float radius = light.edge1.x;
    const Float reach = fma(largest(light.origin) + radius, kOffsetUlps, radius);
    return (!(light.edge1.y > 0.0f)) & (distance2 > reach * reach);
  }

  /// edge1 = (radius, 1 for a flipped normal, 0). A flipped sphere shines inwards.
  static NORRSKEN_INLINE LightSample sample(const SceneView& scene, const Light& light, const Vec3f& reference, Vec2f u,
                                            Mask active) {
    const Float radius = light.edge1.x;
    const Mask flipped = light.edge1.y > 0.0f;
    const Vec3f axis = light.origin - reference;
    const Float distance2 = dot(axis, axis);
    const Float sin2 = radius * radius / distance2;
    const Mask cone = is_outside(light, distance2);

    // A direction of the cone, then its entry point.
    const Float h = one_minus_cos(sin2);
    const Frame frame = make_frame(axis * (1.0f / sqrt(distance2)));
    const Vec3f local = warp_to_cone(u, h);
    const Vec3f direction = frame.to_world(local);
    const Float closest = dot(axis, direction);
    const Vec3f rejected = axis - direction * closest;
    const Float half_chord = sqrt(
        max(fnma(rejected.x, rejected.x, fnma(rejected.y, rejected.y, fnma(rejected.z, rejected.z, radius * radius))),
            0.0f));
    const Vec3f entry = normalize(fma(direction, closest - half_chord, -axis));

    // A point of the area.
    const Vec3f anywhere = warp_to_sphere(u);

    const Vec3f normal = select(cone, entry, anywhere);
    const Vec3f point = fma(normal, radius, light.origin);
    const Vec3f to_light = point - reference;
    const Float d2 = dot(to_light, to_light);
    const Float area_pdf = pdf_sa_from_pdf_area(1.0f / light.area, d2, abs(dot(to_light, normal)) / sqrt(d2));
    const Float scale = largest(point) + radius;
    const Float side = select(cone, Float(1.0f), Float(-1.0f));
    const Color radiance = radiance_at(scene, light, normal, active);
    return {fma(normal, side * scale * kOffsetUlps, point), select(cone, cone_pdf_sa(h), area_pdf), radiance,
            cone | (flipped & (dot(to_light, normal) > 0.0f))};
  }

  static NORRSKEN_INLINE Float pdf_sa(const SceneView&, const Light& light, const Vec3f& reference,
                                      const Vec3f& direction, Float distance, Mask) {
    const Float radius = light.edge1.x;
    const Vec3f axis = light.origin - reference;
    const Float distance2 = dot(axis, axis), sin2 = radius * radius / distance2;
    const Vec3f normal = (fma(direction, distance, -axis)) * (1.0f / radius);
    const Float area_pdf = pdf_sa_from_pdf_area(1.0f / light.area, distance * distance, abs(dot(direction, normal)));
    return select(is_outside(light, distance2), cone_pdf_sa(one_minus_cos(sin2)),
                  zero_unless(light.edge1.y > 0.0f, area_pdf));
  }

  static NORRSKEN_INLINE EmittedRay emit(const SceneView& scene, const Light& light, Vec2f position, Vec2f direction,
                                         Mask active) {
    return emit_from_surface(sample_area(scene, light, position, active), light.area, direction);
  }

  static NORRSKEN_INLINE AreaPoint sample_area(const SceneView& scene, const Light& light, Vec2f u, Mask active) {
    const Float radius = light.edge1.x;
    const Vec3f outward = warp_to_sphere(u);
    const Vec3f normal = outward * select(light.edge1.y > 0.0f, Float(-1.0f), Float(1.0f));
    const Vec3f point = fma(outward, radius, light.origin);
    return {point, normal, radiance_at(scene, light, outward, active), largest(point) + radius, active};
  }

 private:
  /// Where the sphere's outward normal is `outward`.
  static NORRSKEN_INLINE Color radiance_at(const SceneView& scene, const Light& light, const Vec3f& outward,
                                           Mask active) {
    const UInt texture = light_texture(scene, light.parameters, active);
    const Mask textured = active & (texture != 0u);
    return any(textured)
               ? sphere_texture(scene, light.parameters, copied(light.emission), texture, copied(outward), textured)
               : light.emission;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
