// Choosing a light, and what every kind of light gives to next-event estimation.
//
// A kind is a struct with
//   static LightSample sample(const SceneView&, const Light&, const Vec3f& reference, Vec2f u, Mask active);
//   static Float pdf_sa(const SceneView&, const Light&, const Vec3f& reference, const Vec3f& direction,
//                       Float distance, Mask active);
// and, if rays to nowhere see it,
//   static Vec3f radiance(const SceneView&, const Light&, const Vec3f& direction, Mask active);
// Where lights are many they are chosen by place: light/light_tree.h.
// Such lights put their sampled point two scene radii away, behind everything.
// For paths that start at the lights (src/light/emit.h):
//   static EmittedRay emit(const SceneView&, const Light&, Vec2f position, Vec2f direction, Mask active);
#pragma once

#include "math/frame.h"
#include "math/warp.h"
#include "tables/wave_types.h"
#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {

/// A LightRecord in lanes, field by field.
struct Light {
  Float area;
  Vec3f origin, edge1, edge2, normal, emission;
  UInt parameters;  ///< offset of what else the kind keeps in the scene's parameters
};

/// A point on a light, seen from a reference point. `pdf_sa` does not count the choice of the light.
struct LightSample {
  Vec3f point;   ///< on the light, moved off it towards the reference point by the rounding bound
  Float pdf_sa;  ///< 1 for a delta light, whose `radiance` has the falloff in it
  Vec3f radiance;
  Mask valid;  ///< false: this side does not emit
};

inline constexpr std::uint32_t kLightFloats = sizeof(LightRecord) / sizeof(float);
enum LightField : std::uint32_t {
  kLightKind,
  kLightProb,
  kLightArea,
  kLightAliasProb,
  kLightAlias,
  kLightOrigin,
  kLightEdge1 = 8,
  kLightEdge2 = 11,
  kLightNormal = 14,
  kLightEmission = 17,
  kLightParameters = 20
};
static_assert(kLightFloats == 21);

NORRSKEN_INLINE Light broadcast_light(const LightRecord& r) {
  return {Float(r.area),       broadcast(r.origin),   broadcast(r.edge1), broadcast(r.edge2),
          broadcast(r.normal), broadcast(r.emission), UInt(r.parameters)};
}
NORRSKEN_INLINE Light gather_light(const LightRecord* records, UInt index, Mask active) {
  const auto* base = reinterpret_cast<const float*>(records);
  const UInt first = index * UInt(kLightFloats);
  return {gather(base + kLightArea, first, active),           gather3(base + kLightOrigin, first, active),
          gather3(base + kLightEdge1, first, active),         gather3(base + kLightEdge2, first, active),
          gather3(base + kLightNormal, first, active),        gather3(base + kLightEmission, first, active),
          gather_uint(base + kLightParameters, first, active)};
}

/// The word of the texture that is the radiance of lights on surfaces, 0 for lights of one radiance; `parameters` is
/// the lights' own.
template <class Scene>
NORRSKEN_INLINE UInt light_texture(const Scene& scene, UInt parameters, Mask active) {
  if (scene.texture_kinds == 0) return UInt(0u);
  const Mask has_some = active & (parameters != UInt(kNone));
  // Lanes that gather nothing hold anything.
  return select(has_some, gather_uint(scene.parameters, parameters, has_some), UInt(0u));
}

/// Alias method (Walker 1977, Vose 1991): u.x picks a column, u.y one of its two lights. One number for both would
/// have too few bits left for the second choice when there are many lights.
NORRSKEN_INLINE UInt pick_light(const SceneView& scene, Vec2f u, Mask active) {
  const Float scaled = u.x * Float(static_cast<float>(scene.light_count));
  const UInt column = to_uint(min(scaled, Float(static_cast<float>(scene.light_count - 1))));
  const auto* base = reinterpret_cast<const float*>(scene.lights);
  const UInt first = column * UInt(kLightFloats);
  const Mask keep = u.y < gather(base + kLightAliasProb, first, active);
  return select(keep, column, gather_uint(base + kLightAlias, first, active));
}

NORRSKEN_INLINE Float light_prob(const SceneView& scene, UInt light, Mask active) {
  const auto* base = reinterpret_cast<const float*>(scene.lights);
  return gather(base + kLightProb, light * UInt(kLightFloats), active);
}

}  // namespace norrsken::NORRSKEN_ISA
