// BSDFs that stand before others: a mask, a blend, a map of bumps. At each hit they are looked through until a model is
// met, which alone is then evaluated and sampled. Where there is a choice, one random number makes it, with the weights as
// probabilities; what is expected of the image is the weighted sum.
//
// An adapter is a struct with
//   static UInt behind(const ParameterReader&, Float& choice);     the material word behind it; `choice` is a random
//                                                                  number in [0, 1), and is one again afterwards
// and one that perturbs the frame with `Vec3f normal(const ParameterReader&, const Unperturbed&)` too, the new normal in
// the shading frame, of any length. The block of those begins with the word behind and flags (kPerturb...).
#pragma once

#include "bsdf/bsdf.h"
#include "math/frame.h"

namespace norrsken::NORRSKEN_ISA {

/// A surface as it is without its map. Normals are those of the outside, whichever side is looked at.
struct Unperturbed {
  Frame frame;   ///< around the shading normal
  Vec3f normal;  ///< geometric
  Vec3f dp_du, dp_dv;
};

inline constexpr std::uint32_t kPerturbFlips = 1, kPerturbShadows = 2;

/// Takes `first` with this probability, else `second`.
NORRSKEN_INLINE UInt choose(Float prob, UInt first, UInt second, Float& choice) {
  const Mask take = choice < prob;
  const Float rest = Float(1.0f) - prob;
  const Float rescaled = select(take, choice / prob, (choice - prob) / rest);
  // Rounding may reach 1. What was certain leaves nothing to divide by, and has used up nothing.
  choice = min(select((prob > Float(0.0f)) & (rest > Float(0.0f)), rescaled, choice), Float(0x1.fffffep-1f));
  return select(take, first, second);
}

}  // namespace norrsken::NORRSKEN_ISA
