// Next-event estimation over whatever kinds of light the scene has.
#pragma once

#include "light/flat_area.h"
#include "light/light.h"
#include "light/point.h"
#include "light/sphere_area.h"

namespace norrsken::NORRSKEN_ISA {

struct LightChoice {
  LightSample sample;
  Float prob;  ///< of the light
  Mask delta;  ///< a point: no other way of sampling finds it
};

NORRSKEN_INLINE LightSample select(Mask m, const LightSample& a, const LightSample& b) {
  return {select(m, a.point, b.point), select(m, a.pdf_sa, b.pdf_sa), select(m, a.radiance, b.radiance),
          (m & a.valid) | ((!m) & b.valid)};
}

template <class Model>
NORRSKEN_INLINE void add_light_kind(LightKind kind, bool is_delta, const SceneView& scene, UInt light, UInt kinds,
                                    const Vec3f& reference, Vec2f u, Mask active, LightChoice& choice) {
  const Mask of_kind = active & (kinds == UInt(static_cast<std::uint32_t>(kind)));
  if (none(of_kind)) return;
  const LightSample sample = Model::sample(gather_light(scene.lights, light, of_kind), reference, u);
  choice.sample = select(of_kind, sample, choice.sample);
  if (is_delta) choice.delta |= of_kind;
}

/// `pick` chooses the light, `u` the point on it. With one light nothing is looked up.
NORRSKEN_INLINE LightChoice sample_one_light(const SceneView& scene, const Vec3f& reference, Vec2f pick, Vec2f u,
                                             Mask active) {
  const Mask never = Float(1.0f) < Float(0.0f);
  if (scene.light_count == 1) {
    const LightRecord& record = scene.lights[0];
    const Light light = broadcast_light(record);
    switch (record.kind) {
#define NORRSKEN_LIGHT(kind, Model, is_delta) \
  case LightKind::kind:                       \
    return {Model::sample(light, reference, u), Float(1.0f), is_delta ? !never : never};
#include "light/list.def"
#undef NORRSKEN_LIGHT
      case LightKind::count:
        break;
    }
  }
  const UInt light = pick_light(scene, pick, active);
  const auto* base = reinterpret_cast<const float*>(scene.lights);
  const UInt kinds = gather_uint(base + kLightKind, light * UInt(kLightFloats), active);
  LightChoice choice{{reference, Float(1.0f), {Float(0.0f), Float(0.0f), Float(0.0f)}, never},
                     light_prob(scene, light, active),
                     never};
#define NORRSKEN_LIGHT(kind, Model, is_delta)                                  \
  if (scene.light_kinds & (1u << static_cast<std::uint32_t>(LightKind::kind))) \
    add_light_kind<Model>(LightKind::kind, is_delta, scene, light, kinds, reference, u, active, choice);
#include "light/list.def"
#undef NORRSKEN_LIGHT
  return choice;
}

/// The density with which `sample_one_light` finds the point `distance` along `direction`, which lies on `light`.
NORRSKEN_INLINE Float light_pdf_sa(const SceneView& scene, UInt light, const Vec3f& reference, const Vec3f& direction,
                                   Float distance, Mask active) {
  const auto* base = reinterpret_cast<const float*>(scene.lights);
  const UInt kinds = gather_uint(base + kLightKind, light * UInt(kLightFloats), active);
  const Light lanes = gather_light(scene.lights, light, active);
  Float pdf(0.0f);
#define NORRSKEN_LIGHT(kind, Model, is_delta)                                                 \
  if (!is_delta && (scene.light_kinds & (1u << static_cast<std::uint32_t>(LightKind::kind)))) \
    pdf = select(kinds == UInt(static_cast<std::uint32_t>(LightKind::kind)),                  \
                 Model::pdf_sa(lanes, reference, direction, distance), pdf);
#include "light/list.def"
#undef NORRSKEN_LIGHT
  return pdf * light_prob(scene, light, active);
}

}  // namespace norrsken::NORRSKEN_ISA
