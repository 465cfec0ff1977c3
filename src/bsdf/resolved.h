// BSDFs that stand before others: a mask, a blend, a map of bumps. At each hit they are looked through until a model is
// met, which alone is then evaluated and sampled. Where there is a choice, it is made by chance, with the weights as
// probabilities, or all ways are gone one after the other, each with its weight; what is expected of the image is the
// weighted sum either way.
//
// An adapter is a struct with
//   static UInt behind(const ParameterReader&, Choice&);     the material word behind it
// but one that perturbs the frame has instead
//   static Vec3f normal(const ParameterReader&, const Unperturbed&);     the new normal in the frame there, of any length
// and its block begins with PerturbedSlots. Both have a `Stored`, as models do (bsdf.h).
#pragma once

#include "bsdf/bsdf.h"
#include "math/frame.h"

namespace norrsken::NORRSKEN_ISA {

/// What the block of a map begins with.
struct PerturbedSlots {
  MaterialWord inside[2];  ///< behind it, for what is then seen from the front and from the back
  std::uint32_t flags;     ///< kPerturb...
};

/// A surface as it is without a map. Normals are those of the outside, whichever side is looked at.
struct Unperturbed {
  Frame frame;   ///< around the shading normal, that of the maps around this one
  Vec3f normal;  ///< geometric
  Vec3f dp_du, dp_dv;
};

/// How a hit finds its way to a model: by chance, or by a code that has one bit for each choice on the way.
class Choice {
 public:
  /// `number` is random, in [0, 1).
  static NORRSKEN_INLINE Choice by_chance(Float number) { return {number, 0u, 1.0f, false}; }
  static NORRSKEN_INLINE Choice by_code(std::uint32_t code) { return {0.0f, UInt(code), 1.0f, true}; }

  /// Takes `first` with this probability, else `second`.
  NORRSKEN_INLINE UInt take(Float prob, UInt first, UInt second, Mask active) {
    const Float rest = 1.0f - prob;
    if (coded_) {
      const Mask take = (code_ & 1u) == 0u;
      weight_ = select(active, weight_ * select(take, prob, rest), weight_);
      code_ = select(active, shift_right<1>(code_), code_);
      return select(take, first, second);
    }
    const Mask take = number_ < prob;
    const Float rescaled = select(take, number_ / prob, (number_ - prob) / rest);
    // Rounding may reach 1. What was certain leaves nothing to divide by, and has used up nothing.
    const Mask uncertain = active & (prob > 0.0f) & (rest > 0.0f);
    number_ = min(select(uncertain, rescaled, number_), 0x1.fffffep-1f);
    return select(take, first, second);
  }

  /// Product of the probabilities of the ways that the code took; 1 by chance.
  Float weight() const { return weight_; }
  /// Whether this is a way to a model: the code has no bits beyond the choices met.
  NORRSKEN_INLINE Mask is_way() const { return (code_ == 0u) & (weight_ > 0.0f); }

 private:
  NORRSKEN_INLINE Choice(Float number, UInt code, Float weight, bool coded)
      : number_(number), code_(code), weight_(weight), coded_(coded) {}
  Float number_;
  UInt code_;
  Float weight_;
  bool coded_;
};

}  // namespace norrsken::NORRSKEN_ISA
