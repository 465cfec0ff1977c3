// A BSDF's direction with the random numbers of its bounce, whichever way the path runs.
#pragma once

#include "bsdf/bsdf.h"
#include "sampler/sampler.h"

namespace norrsken::NORRSKEN_ISA {

/// `dimension` is the first of the hit's.
template <class Model>
NORRSKEN_INLINE BsdfSample sample_bsdf(const Sampler& sampler, const SampleKey& key, std::uint32_t dimension,
                                       const typename Model::Parameters& bsdf, const Vec3f& wo) {
  Vec2f u{0.0f, 0.0f};
  if (!Model::kDelta) u = sampler.sample_2d(key, dimension + hit_dimension::kBsdfDirection);
  Float lobe(0.0f);
  if (Model::kUsesLobe) lobe = sampler.sample_1d(key, dimension + hit_dimension::kBsdfLobe);
  return Model::sample(bsdf, wo, lobe, u);
}

}  // namespace norrsken::NORRSKEN_ISA
