// Choosing a light, and what every kind of light gives to next-event estimation.
//
// A kind is a struct with
//   static LightSample sample(const SceneView&, const Light&, const Vec3f& reference, Vec2f u, Mask active);
//   static Float pdf_sa(const SceneView&, const Light&, const Vec3f& reference, const Vec3f& direction,
//                       Float distance, Mask active);
// and, if rays to nowhere see it,
//   static SeenLight seen(const SceneView&, const Light&, const Vec3f& direction, Mask active);
// Where lights are many they are chosen by place: light/light_tree.h.
// Such lights put their sampled point at distance_to_lights_around, behind everything.
// For paths that start at the lights (src/light/emit.h):
//   static EmittedRay emit(const SceneView&, const Light&, Vec2f position, Vec2f direction, Mask active);
#pragma once

#include "math/frame.h"
#include "math/gather.h"
#include "math/warp.h"
#include "tables/wave_types.h"
#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {

/// A LightRecord in lanes, field by field.
struct Light {
  Float area;
  Vec3f origin, edge1, edge2, normal;
  Color emission;
  UInt parameters;  ///< offset of what else the kind keeps in the scene's parameters
};

/// A point on a light, seen from a reference point. `pdf_sa` does not count the choice of the light.
struct LightSample {
  Vec3f point;   ///< on the light, moved off it towards the reference point by the rounding bound
  Float pdf_sa;  ///< 1 for a delta light, whose `radiance` has the falloff in it
  Color radiance;
  Mask valid;  ///< false: this side does not emit
};

/// What lies in a direction, and the density with which that is sampled.
struct SeenLight {
  Color radiance;
  Float pdf_sa;
};

/// Where lights around the scene stand, seen from any point of it: two of its radii away.
NORRSKEN_INLINE Float distance_to_lights_around(const SceneView& scene) { return 2.0f * scene.radius; }

NORRSKEN_INLINE Light broadcast_light(const LightRecord& r) {
  return {Float(r.area),       broadcast(r.origin),         broadcast(r.edge1), broadcast(r.edge2),
          broadcast(r.normal), broadcast_color(r.emission), UInt(r.parameters)};
}
NORRSKEN_INLINE Color gather_emission(const LightRecord* records, UInt index, Mask active) {
  return gather_color(records->emission, record_offset<LightRecord>(index), active);
}
NORRSKEN_INLINE Light gather_light(const LightRecord* records, UInt index, Mask active) {
  const auto of_light = [&](auto member) { return gather(records, member, index, active); };
  return {of_light(&LightRecord::area),      of_light(&LightRecord::origin), of_light(&LightRecord::edge1),
          of_light(&LightRecord::edge2),     of_light(&LightRecord::normal), gather_emission(records, index, active),
          of_light(&LightRecord::parameters)};
}

/// The word of the texture that is the radiance of lights on surfaces, 0 for lights of one radiance; `parameters` is
/// the lights' own.
template <class Scene>
NORRSKEN_INLINE UInt light_texture(const Scene& scene, UInt parameters, Mask active) {
  if (scene.texture_kinds == 0) return 0u;
  const Mask has_some = active & (parameters != kNone);
  // Lanes that gather nothing hold anything.
  return select(has_some, gather_uint(scene.parameters, parameters, has_some), 0u);
}

/// Alias method (Walker 1977, Vose 1991): u.x picks a column, u.y one of its two lights. One number for both would
/// have too few bits left for the second choice when there are many lights.
NORRSKEN_INLINE UInt pick_light(const SceneView& scene, Vec2f u, Mask active) {
  const Float scaled = u.x * Float(static_cast<float>(scene.light_count));
  const UInt column = to_uint(min(scaled, Float(static_cast<float>(scene.light_count - 1))));
  const Mask keep = u.y < gather(scene.lights, &LightRecord::alias_prob, column, active);
  return select(keep, column, gather(scene.lights, &LightRecord::alias, column, active));
}

NORRSKEN_INLINE Float light_prob(const SceneView& scene, UInt light, Mask active) {
  return gather(scene.lights, &LightRecord::prob, light, active);
}

}  // namespace norrsken::NORRSKEN_ISA
