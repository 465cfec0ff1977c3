// Where paths from the lights begin: a ray from whatever kinds of light the scene has.
#pragma once

#include "light/sample_lights.h"

namespace norrsken::NORRSKEN_ISA {

template <class Model>
NORRSKEN_INLINE void add_emission_of_kind(LightKind kind, const SceneView& scene, UInt light, UInt kinds,
                                          Vec2f position, Vec2f direction, Mask active, EmittedRay& ray) {
  const Mask of_kind = active & (kinds == UInt(static_cast<std::uint32_t>(kind)));
  if (none(of_kind)) return;
  const EmittedRay r = Model::emit(scene, gather_light(scene.lights, light, of_kind), position, direction, of_kind);
  ray.origin = select(of_kind, r.origin, ray.origin);
  ray.direction = select(of_kind, r.direction, ray.direction);
  ray.weight = select(of_kind, r.weight, ray.weight);
  ray.valid |= of_kind & r.valid;
}

/// `pick` chooses the light, `position` and `direction` the ray; the weight counts the choice.
inline EmittedRay emit_from_lights(const SceneView& scene, Vec2f pick, Vec2f position, Vec2f direction, Mask active) {
  const UInt light = pick_light(scene, pick, active);
  const UInt kinds = gather_light_kind(scene, light, active);
  const Vec3f zero{0.0f, 0.0f, 0.0f};
  EmittedRay ray{zero, zero, black(), Mask::none()};
#define NORRSKEN_LIGHT(kind, Model, is_delta)                                  \
  if (scene.light_kinds & (1u << static_cast<std::uint32_t>(LightKind::kind))) \
    add_emission_of_kind<Model>(LightKind::kind, scene, light, kinds, position, direction, active, ray);
#include "lists/light.def"
#undef NORRSKEN_LIGHT
  ray.weight = ray.weight * (1.0f / light_prob(scene, light, active));
  return ray;
}

}  // namespace norrsken::NORRSKEN_ISA
