// Stage: hits of materials that stand before others -> HITS of the models behind them.
#pragma once

#include "bsdf/models.h"
#include "wave/hits.h"
#include "wave/perturbed_frame.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// Enters a map in each lane that has one: puts it behind those that the hit has met, and leads on by the side that the
/// ray comes from as the frame is then.
NORRSKEN_INLINE void look_behind_map(const SceneView& scene, const SurfacePoint& surface, Hit& hit, MappedFrame& frame,
                                     Mask maps) {
  const UInt map = hit.material & UInt(kMaterialKindMask | kMaterialOffsetMask);
  Mask unplaced = maps;
  for (UInt& place : hit.maps) {
    const Mask here = unplaced & (place == 0u);
    place = select(here, map, place);
    unplaced = unplaced & !here;
  }
  frame = enter_map(scene, map, copied(hit.ray.direction), copied(surface), frame, maps).inside;
  const UInt back = select(frame.from_back(hit.ray.direction), UInt(1u), UInt(0u));
  const float* inside = scene.parameters + floats_before(&PerturbedSlots::inside);
  const UInt behind = gather_uint(inside, (map & UInt(kMaterialOffsetMask)) + back, maps);
  hit.material = select(maps, behind, hit.material);
}

template <class Adapter>
NORRSKEN_INLINE void look_behind_adapter(const SceneView& scene, const SurfacePoint& surface, Hit& hit,
                                         MappedFrame& frame, Choice& choice, Mask of_kind) {
  const ParameterReader parameters{scene, hit.material & kMaterialOffsetMask, surface.texture, of_kind};
  if constexpr (requires { Adapter::behind(parameters, choice); }) {
    hit.material = select(of_kind, Adapter::behind(parameters, choice), hit.material);
  } else {
    look_behind_map(scene, surface, hit, frame, of_kind);
  }
}

/// Looks through one adapter in each lane that has one.
NORRSKEN_INLINE void look_behind(const SceneView& scene, const SurfacePoint& surface, Hit& hit, MappedFrame& frame,
                                 Choice& choice, Mask open) {
  const UInt kind_bits = hit.material & kMaterialKindMask;
#define NORRSKEN_BSDF_RESOLVED(kind, Adapter)                                                    \
  if (scene.bsdf_kinds & (1u << static_cast<std::uint32_t>(BsdfKind::kind))) {                   \
    const Mask of_kind = open & (kind_bits == UInt(make_material(BsdfKind::kind, 0)));           \
    if (any(of_kind)) look_behind_adapter<Adapter>(scene, surface, hit, frame, choice, of_kind); \
  }
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_RESOLVED
}

inline constexpr std::uint32_t kByChance = ~0u;

/// Finds one model behind each hit: by chance, or the one that `code` leads to, if any, with the throughput weighted.
/// `wanted_kinds` as in intersect_closest.
inline void resolve_materials(const SceneView& scene, std::uint32_t first_dimension, std::uint32_t code,
                              std::uint32_t wanted_kinds, const Hits& unresolved_hits, const Slots& slots,
                              Hits (&hits)[kModelCount]) {
  const Sampler sampler{scene.sampler.kind};
  const std::uint32_t dimension = first_dimension + hit_dimension::kMaterial;
  for (std::uint32_t i = 0; i < unresolved_hits.count; i += kLanes) {
    Mask active = first_lanes(unresolved_hits.count - i);
    Hit hit = load<Hit>(scene, unresolved_hits, i);
    const SurfacePoint surface = make_surface_point(scene, hit, active);
    const SampleKey key = load_sample_key(slots, hit.ray.slot, active);
    Choice choice = code == kByChance ? Choice::by_chance(sampler.sample_1d(key, dimension)) : Choice::by_code(code);
    MappedFrame frame = unmapped_frame(surface);
    const auto unresolved = [&] { return active & is_unresolved(hit.material); };
    // Comes to an end: a word leads only to words that were made before it.
    for (Mask open = unresolved(); any(open); open = unresolved())
      look_behind(scene, surface, hit, frame, choice, open);
    if (code != kByChance) {
      active &= choice.is_way();
      hit.ray.throughput = hit.ray.throughput * choice.weight();
    }
    push_by_kind(scene, hit, wanted_kinds, hits, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
