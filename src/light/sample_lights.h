// Next-event estimation over whatever kinds of light the scene has.
#pragma once

#include "light/light.h"
#include "light/light_tree.h"
#include "light/models.h"

namespace norrsken::NORRSKEN_ISA {

struct LightChoice {
  LightSample sample;
  Float prob;         ///< of the light
  Float weight_prob;  ///< what a ray that finds the light by itself reckons with in its place
  Mask delta;         ///< a point or a direction: no other way of sampling finds it
};

NORRSKEN_INLINE LightSample select(Mask m, const LightSample& a, const LightSample& b) {
  return {select(m, a.point, b.point), select(m, a.pdf_sa, b.pdf_sa), select(m, a.radiance, b.radiance),
          (m & a.valid) | ((!m) & b.valid)};
}

NORRSKEN_INLINE UInt gather_light_kind(const SceneView& scene, UInt light, Mask active) {
  return gather(scene.lights, &LightRecord::kind, light, active);
}

template <class Model>
NORRSKEN_INLINE void add_light_kind(LightKind kind, bool is_delta, const SceneView& scene, UInt light, UInt kinds,
                                    const Vec3f& reference, Vec2f u, Mask active, LightChoice& choice) {
  const Mask of_kind = active & (kinds == UInt(static_cast<std::uint32_t>(kind)));
  if (none(of_kind)) return;
  const LightSample sample = Model::sample(scene, gather_light(scene.lights, light, of_kind), reference, u, of_kind);
  choice.sample = select(of_kind, sample, choice.sample);
  if (is_delta) choice.delta |= of_kind;
}

/// Not inlined: every BSDF would repeat the code of every kind of light.
__attribute__((noinline)) inline LightChoice sample_one_of_many_lights(const SceneView& scene, Vec3f reference,
                                                                       Receiver receiver, Vec2f pick, Vec2f u,
                                                                       Mask active) {
  const Mask never = Mask::none();
  PickedLight picked;
  if (scene.light_nodes != nullptr) {
    picked = pick_light_by_place(scene, reference, receiver, pick, active);
  } else {
    picked.light = pick_light(scene, pick, active);
    picked.prob = picked.weight_prob = light_prob(scene, picked.light, active);
  }
  const UInt light = picked.light;
  const UInt kinds = gather_light_kind(scene, light, active);
  LightChoice choice{{reference, 1.0f, black(), never}, picked.prob, picked.weight_prob, never};
#define NORRSKEN_LIGHT(kind, Model, is_delta)                                  \
  if (scene.light_kinds & (1u << static_cast<std::uint32_t>(LightKind::kind))) \
    add_light_kind<Model>(LightKind::kind, is_delta, scene, light, kinds, reference, u, active, choice);
#include "lists/light.def"
#undef NORRSKEN_LIGHT
  return choice;
}

/// `pick` chooses the light, for what the receiver may take of it; `u` the point on it. The one parallelogram or point of a simple scene is sampled in place.
template <class Scene>
NORRSKEN_INLINE LightChoice sample_one_light(const Scene& scene, const Vec3f& reference, const Receiver& receiver,
                                             Vec2f pick, Vec2f u, Mask active) {
  if (scene.light_count == 1) {
    const Mask never = Mask::none();
    const LightRecord& record = scene.lights[0];
    if (record.kind == LightKind::parallelogram) {
      return {FlatAreaLight<false>::sample(scene, broadcast_light(record), reference, u, active), 1.0f, 1.0f, never};
    }
    if (record.kind == LightKind::point) {
      return {PointLight::sample(scene, broadcast_light(record), reference, u, active), 1.0f, 1.0f, !never};
    }
  }
  return sample_one_of_many_lights(scene, copied(reference), {copied(receiver.normal), receiver.least}, pick, u,
                                   active);
}

/// The probability with which `sample_one_light` chooses the light for any_receiver().
NORRSKEN_INLINE Float light_share(const SceneView& scene, UInt light, const Vec3f& reference, Mask active) {
  if (scene.light_nodes != nullptr) return light_prob_by_place(scene, light, copied(reference), active);
  return light_prob(scene, light, active);
}

/// The density with which `sample_one_light` finds for any_receiver() the point `distance` along `direction`, which lies on `light`.
inline Float light_pdf_sa(const SceneView& scene, UInt light, Vec3f reference, Vec3f direction, Float distance,
                          Mask active) {
  const UInt kinds = gather_light_kind(scene, light, active);
  const Light lanes = gather_light(scene.lights, light, active);
  Float pdf(0.0f);
#define NORRSKEN_LIGHT(kind, Model, is_delta)                                                           \
  if (!is_delta && (scene.light_kinds & (1u << static_cast<std::uint32_t>(LightKind::kind)))) {         \
    const Mask of_kind = active & (kinds == UInt(static_cast<std::uint32_t>(LightKind::kind)));         \
    if (any(of_kind))                                                                                   \
      pdf = select(of_kind, Model::pdf_sa(scene, lanes, reference, direction, distance, of_kind), pdf); \
  }
#include "lists/light.def"
#undef NORRSKEN_LIGHT
  return pdf * light_share(scene, light, reference, active);
}

/// What a ray to nowhere sees: the scene's environment. The density does not count the choice of the light.
inline SeenLight environment_seen(const SceneView& scene, Vec3f direction, Mask active) {
  const LightRecord& record = scene.lights[scene.environment];
  const Light light = broadcast_light(record);
  switch (record.kind) {
#define NORRSKEN_ENVIRONMENT(kind, Model) \
  case LightKind::kind:                   \
    return Model::seen(scene, light, direction, active);
#include "lists/environment.def"
#undef NORRSKEN_ENVIRONMENT
    default:
      return {black(), 0.0f};
  }
}

}  // namespace norrsken::NORRSKEN_ISA
