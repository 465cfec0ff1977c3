// From a place where a medium scatters to the queue of the phase function there.
#pragma once

#include "medium/models.h"
#include "wave/media.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

NORRSKEN_INLINE Mask is_phase(UInt word, PhaseKind kind, Mask active) {
  return active & ((word & kPhaseKindMask) == UInt(make_phase(kind, 0)));
}

/// One of those that a `blendphase` blends, by chance. `number` is random; what is left of it comes back.
inline UInt choose_phase(const SceneView& scene, UInt word, const Vec3f& position, Float& number, Mask blends) {
  const UInt offset = word & kPhaseOffsetMask;
  const auto of_blend = [&](auto member) { return gather_slot(scene.parameters, member, offset, blends); };
  Float weight = of_blend(&PhaseBlend::weight);
  const UInt volume = of_blend(&PhaseBlend::volume);
  const Mask varies = blends & (volume != kNone);
  if (any(varies)) {
    const Color found = evaluate_volume(scene, volume, copied(position), varies);
    weight = select(varies, min(max(sum_of(found) * (1.0f / 3.0f), 0.0f), 1.0f), weight);
  }
  const Mask second = number < weight;
  const Float rescaled = select(second, number / weight, (number - weight) / (1.0f - weight));
  number = select(blends, min(max(rescaled, 0.0f), 0x1.fffffep-1f), number);
  return select(second, of_blend(&PhaseBlend::second), of_blend(&PhaseBlend::first));
}

/// `ray` has been brought to the place, with the throughput that is left there; `number` is random.
inline void push_scatters(const SceneView& scene, const Ray& ray, Float number, Scatters (&scatters)[kPhaseModelCount],
                          Mask active) {
  const Mask alive = active & !(max_component(ray.throughput) <= 0.0f);
  UInt phase = gather_medium(scene, &MediumRecord::phase, ray.medium, alive);
  if ((scene.phase_kinds >> kPhaseModelCount) != 0) {
    // Comes to an end: a word leads only to words that were made before it.
    const auto blends = [&] { return is_phase(phase, PhaseKind::blendphase, alive); };
    for (Mask open = blends(); any(open); open = blends())
      phase = select(open, choose_phase(scene, phase, ray.origin, number, open), phase);
  }
  for (std::uint32_t kind = 0; kind < kPhaseModelCount; ++kind) {
    if ((scene.phase_kinds >> kind & 1u) == 0) continue;
    const Mask of_kind = is_phase(phase, static_cast<PhaseKind>(kind), alive);
    if (any(of_kind)) push(scene, scatters[kind], Scatter{.ray = ray, .phase = phase}, of_kind);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
