// Stage: hits of materials that stand before others -> HITS of the models behind them.
#pragma once

#include "bsdf/blendbsdf.h"
#include "bsdf/bumpmap.h"
#include "bsdf/mask.h"
#include "bsdf/normalmap.h"
#include "sampler/sampler.h"
#include "wave/generate_camera_rays.h"
#include "wave/intersect_closest.h"

namespace norrsken::NORRSKEN_ISA {

/// Looks through one adapter in each lane that has one; `bump` remembers the maps on the way.
NORRSKEN_INLINE void look_behind(const SceneView& scene, const TexturePoint& point, UInt& word, UInt& bump,
                                 Choice& choice, Mask open) {
  const UInt kind_bits = word & UInt(kMaterialKindMask), offset = word & UInt(kMaterialOffsetMask);
#define NORRSKEN_BSDF_RESOLVED(kind, Adapter)                                          \
  if (scene.bsdf_kinds & (1u << static_cast<std::uint32_t>(BsdfKind::kind))) {         \
    const Mask of_kind = open & (kind_bits == UInt(make_material(BsdfKind::kind, 0))); \
    if (any(of_kind)) {                                                                \
      const UInt behind = Adapter::behind({scene, offset, point, of_kind}, choice);    \
      word = select(of_kind, behind, word);                                            \
    }                                                                                  \
  }
#define NORRSKEN_BSDF_PERTURBING(kind, Adapter) \
  bump = select(open & (kind_bits == UInt(make_material(BsdfKind::kind, 0))), kind_bits | offset, bump);
#include "bsdf/resolved.def"
#undef NORRSKEN_BSDF_PERTURBING
#undef NORRSKEN_BSDF_RESOLVED
}

inline constexpr std::uint32_t kByChance = ~0u;

/// Finds one model behind each hit: by chance, or the one that `code` leads to, if any, with the throughput weighted.
/// `wanted_kinds` as in intersect_closest.
inline void resolve_materials(const SceneView& scene, std::uint32_t hit_number, std::uint32_t code,
                              std::uint32_t wanted_kinds, WaveMemory& memory) {
  const Sampler sampler{scene.sampler.kind};
  const Queue& hits = memory.unresolved_hits;
  const std::uint32_t dimension = first_dimension_of_hit(hit_number) + hit_dimension::kMaterial;
  for (std::uint32_t i = 0; i < hits.count; i += kLanes) {
    Mask active = first_lanes(hits.count - i);
    Hit hit = load_hit(scene, hits, i);
    const SurfacePoint surface = make_surface_point(scene, hit, active);
    const SampleKey key = load_sample_key(memory.slots, hit.ray.slot, active);
    Choice choice = code == kByChance ? Choice::by_chance(sampler.sample_1d(key, dimension)) : Choice::by_code(code);
    const auto unresolved = [&] {
      return active &
             !(to_float(hit.material & UInt(kMaterialKindMask)) < Float(static_cast<float>(kModelCount << 24)));
    };
    // Comes to an end: a word leads only to words that were made before it.
    for (Mask open = unresolved(); any(open); open = unresolved())
      look_behind(scene, surface.texture, hit.material, hit.bump, choice, open);
    if (code != kByChance) {
      active &= choice.is_way();
      hit.ray.throughput = hit.ray.throughput * choice.weight();
    }
    push_by_kind(scene, hit, wanted_kinds, memory, active);
  }
}

}  // namespace norrsken::NORRSKEN_ISA
