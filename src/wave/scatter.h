// From a place where a medium scatters to the queue of the phase function there.
#pragma once

#include "medium/models.h"
#include "wave/media.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

using Scatters = Rays[kPhaseModelCount];

/// `ray` has been brought to the place, with the throughput that is left there.
inline void push_scatters(const SceneView& scene, const Ray& ray, Scatters& scatters, Mask active) {
  const Mask alive = active & !(max_component(ray.throughput) <= 0.0f);
  const UInt phase = gather_medium(scene, &MediumRecord::phase, ray.medium, alive);
  const UInt kind_bits = phase & kPhaseKindMask;
  for (std::uint32_t kind = 0; kind < kPhaseModelCount; ++kind) {
    if ((scene.phase_kinds >> kind & 1u) == 0) continue;
    const Mask of_kind = alive & (kind_bits == UInt(make_phase(static_cast<PhaseKind>(kind), 0)));
    if (any(of_kind)) push(scene, scatters[kind], ray, of_kind);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
