// One sampler for kernels: the kind is the same for a whole render, so choosing costs a predicted branch.
#pragma once

#include "sampler/dimensions.h"
#include "sampler/independent.h"
#include "sampler/sobol.h"
#include "tables/scene_tables.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

/// The address of a path's random numbers: see `make_sample_key`.
struct SampleKey {
  UInt key;
  UInt index;  ///< of the point (Sobol'), or the step through the dimensions (independent)
};

/// `pixel` counts over the whole film, so the key does not depend on how the film is cut into tiles.
/// Independent: a start and a step per sample. Sobol': a key per pixel and replicate, and the point's index within the
/// replicate; replicates are independent scramblings, from whose spread the film tells the error.
NORRSKEN_INLINE SampleKey make_sample_key(SamplerKind kind, std::uint64_t seed, UInt pixel, std::uint32_t sample) {
  const UInt low(static_cast<std::uint32_t>(seed)), high(static_cast<std::uint32_t>(seed >> 32));
  const UInt pixel_key = hash(hash(pixel, low), high);
  if (kind == SamplerKind::independent) {
    return {hash(pixel_key ^ UInt(sample)), hash(pixel_key + UInt(sample), high + 1u) | 1u};
  }
  return {hash(pixel_key, UInt(sample % kReplicates)), UInt(sample / kReplicates)};
}

struct Sampler {
  SamplerKind kind;

  NORRSKEN_INLINE Float sample_1d(const SampleKey& k, std::uint32_t dimension) const {
    if (kind == SamplerKind::independent) return IndependentSampler::sample_1d(k.key, k.index, dimension);
    return SobolSampler::sample_1d(k.key, k.index, dimension);
  }
  NORRSKEN_INLINE Vec2f sample_2d(const SampleKey& k, std::uint32_t dimension) const {
    if (kind == SamplerKind::independent) return IndependentSampler::sample_2d(k.key, k.index, dimension);
    return SobolSampler::sample_2d(k.key, k.index, dimension);
  }
  /// The key of repetition `i` of `n` at one hit: `n` times as many points of one sequence.
  NORRSKEN_INLINE SampleKey repetition(const SampleKey& k, std::uint32_t i, std::uint32_t n) const {
    if (n == 1) return k;
    if (kind == SamplerKind::independent) return {hash(k.key, UInt(i + 1)), k.index};
    return {k.key, k.index * UInt(n) + UInt(i)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
